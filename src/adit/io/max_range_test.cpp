#include "adit/io/max_range.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace adit {
namespace {

/// Ranges as a scanner among walls gives them: many near, few far, in whole centimetres.
std::vector<double> measured(std::size_t count, double far, std::mt19937_64& random) {
  std::exponential_distribution<double> range(1.0 / 3.0);
  std::vector<double> out;
  while (out.size() < count) {
    const double r = std::round(100.0 * (0.5 + range(random))) / 100.0;
    if (r < far) out.push_back(r);
  }
  return out;
}

TEST(MaxRange, TheTopValueThatManyBeamsShare) {
  std::mt19937_64 random(1);
  MaxRangeFinder finder;
  finder.add(measured(100000, 40.0, random));
  EXPECT_FALSE(finder.find());
  finder.add(std::vector<double>(500, 81.83));
  EXPECT_EQ(finder.find(), 81.83);
  EXPECT_EQ(finder.largest(), 81.83);
}

TEST(MaxRange, IsFoundAmongMeasuredValuesThatReachIt) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> far(30.0, 50.0);
  MaxRangeFinder finder;
  finder.add(measured(100000, 30.0, random));
  for (int i = 0; i < 4000; ++i)
    finder.add(std::vector<double>{std::round(100.0 * far(random)) / 100.0});
  EXPECT_FALSE(finder.find());
  finder.add(std::vector<double>(800, 50.0));
  EXPECT_EQ(finder.find(), 50.0);
}

TEST(MaxRange, OddValuesAboveItDoNotHideIt) {
  std::mt19937_64 random(3);
  MaxRangeFinder finder;
  finder.add(measured(10000, 40.0, random));
  finder.add(std::vector<double>(300, 80.0));
  finder.add(std::vector<double>{655.35, 120.0, 1e9, 97.3});
  EXPECT_EQ(finder.find(), 80.0);
}

TEST(MaxRange, TheLowestOfSeveralCodesCounts) {
  std::mt19937_64 random(4);
  MaxRangeFinder finder;
  finder.add(measured(200000, 60.0, random));
  finder.add(std::vector<double>(20000, 81.91));
  finder.add(std::vector<double>(300, 81.83));
  finder.add(std::vector<double>{81.82, 81.79, 81.77, 80.9});
  EXPECT_EQ(finder.find(), 81.83);
  EXPECT_EQ(finder.find(81.90), 81.83);
  EXPECT_EQ(finder.find(50.0), std::nullopt);
  EXPECT_EQ(finder.find(81.85), 81.83);
}

TEST(MaxRange, OneScanIsEnoughWhereItStandsApart) {
  MaxRangeFinder finder;
  finder.add(std::vector<double>{3.21, 3.22, 3.25, 3.3, 4.1, 81.83, 81.83});
  EXPECT_EQ(finder.find(), 81.83);
  MaxRangeFinder lonely;
  lonely.add(std::vector<double>{3.21, 3.22, 3.25, 3.3, 4.1, 81.83});
  EXPECT_FALSE(lonely.find());
}

TEST(MaxRange, ExactEvenWithFinerSteps) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> range(1.0, 30.0);
  MaxRangeFinder finder;
  for (int i = 0; i < 20000; ++i) finder.add(std::vector<double>{range(random)});
  finder.add(std::vector<double>{29.9967});
  finder.add(std::vector<double>(100, 29.9985));
  EXPECT_EQ(finder.find(), 29.9985);
}

TEST(MaxRange, AWallThatFillsTheViewIsNoCode) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> noise(12.0, 0.02);
  MaxRangeFinder finder;
  finder.add(measured(20000, 12.0, random));
  for (int i = 0; i < 3000; ++i)
    finder.add(std::vector<double>{std::round(100.0 * noise(random)) / 100.0});
  EXPECT_FALSE(finder.find());
}

TEST(MaxRange, APartOfTheMachineInViewIsNoCode) {
  MaxRangeFinder finder;
  for (int i = 0; i < 100; ++i) finder.add(std::vector<double>{1.2, 5.0 + 0.37 * i});
  EXPECT_FALSE(finder.find());
}

TEST(MaxRange, OneReadingOfAHundredThousandKilometresIsNoMeasurement) {
  MaxRangeFinder finder;
  finder.add(std::vector<double>{4.0, 12.5, 1.1e8, 655.37, 31.0});
  EXPECT_EQ(finder.largest(), 31.0);
  finder.add(std::vector<double>{655.36});
  EXPECT_EQ(finder.largest(), 655.36);
  EXPECT_FALSE(finder.find());
}

TEST(MaxRange, IgnoresWhatIsNoRange) {
  MaxRangeFinder finder;
  finder.add(std::vector<double>{});
  EXPECT_FALSE(finder.find());
  finder.add(std::vector<double>{0.0, -5.0, std::nan(""), std::numeric_limits<double>::infinity()});
  EXPECT_FALSE(finder.find());
  EXPECT_EQ(finder.largest(), 0.0);
}

}  // namespace
}  // namespace adit
