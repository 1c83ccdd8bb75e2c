#include "adit/evaluation/chi_square.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace adit {
namespace {

TEST(ChiSquare, QuantilesOfTheTables) {
  EXPECT_NEAR(chi_square_quantile(0.95, 1), 3.841, 5e-4);
  EXPECT_NEAR(chi_square_quantile(0.95, 2), 5.991, 5e-4);
  EXPECT_NEAR(chi_square_quantile(0.95, 3), 7.8147, 5e-5);
  EXPECT_NEAR(chi_square_quantile(0.99, 3), 11.345, 5e-4);
  EXPECT_NEAR(chi_square_quantile(0.999, 3), 16.266, 5e-4);
  EXPECT_NEAR(chi_square_quantile(0.05, 10), 3.940, 5e-4);
  EXPECT_NEAR(chi_square_quantile(0.95, 10), 18.307, 5e-4);
  EXPECT_NEAR(chi_square_quantile(0.975, 100), 129.561, 5e-4);
}

TEST(ChiSquare, TailsOfTheTables) {
  EXPECT_NEAR(chi_square_tail(1.0, 1), 0.3173105, 1e-7);
  EXPECT_NEAR(chi_square_tail(2.0, 2), std::exp(-1.0), 1e-15);
  EXPECT_NEAR(chi_square_tail(2.366, 3), 0.5, 1e-4);
  EXPECT_NEAR(chi_square_tail(9.488, 4), 0.05, 1e-5);
}

TEST(ChiSquare, QuantileInvertsTheTail) {
  for (int dof = 1; dof <= 40; ++dof) {
    for (const double p : {0.01, 0.3, 0.5, 0.9, 0.999}) {
      EXPECT_NEAR(chi_square_tail(chi_square_quantile(p, dof), dof), 1.0 - p, 1e-12)
          << p << " at " << dof;
    }
  }
}

TEST(ChiSquare, Ends) {
  EXPECT_EQ(chi_square_tail(0.0, 3), 1.0);
  EXPECT_EQ(chi_square_tail(-1.0, 3), 1.0);
  EXPECT_EQ(chi_square_tail(std::numeric_limits<double>::infinity(), 3), 0.0);
  EXPECT_EQ(chi_square_quantile(0.0, 3), 0.0);
  EXPECT_TRUE(std::isinf(chi_square_quantile(1.0, 3)));
}

}  // namespace
}  // namespace adit
