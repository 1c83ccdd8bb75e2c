#include "adit/refinement/whitening.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "adit/simulation/random.hpp"
#include "support/draws.hpp"

namespace adit {
namespace {

constexpr int kParameters = 6;
using Equations = NormalEquations<kParameters>;
using Gradient = Equations::Vector;

/// A beam as the whitener takes it.
struct Point {
  Vector2d hit = Vector2d::Zero();
  Vector2d normal = Vector2d::Zero();
  double residual = 0.0;
  Gradient gradient = Gradient::Zero();
  double stretch = 0.0;
  double variance = 0.0;
};

Equations whitened(const std::vector<Point>& points, const MapError& error) {
  OffsetWhitener<kParameters> whitener(error);
  Equations sum;
  for (const Point& point : points) {
    whitener.move_to(point.hit, point.normal);
    whitener.add(point.residual, point.gradient, error.offset_sigma_m * point.stretch,
                 point.variance, sum);
  }
  return sum;
}

/// How much of the offset a point shares with the one before.
double correlation(const Point& before, const Point& point, const MapError& error) {
  const double lengths = (point.hit - before.hit).norm() / error.length_m;
  const double bend = std::max(0.0, point.normal.dot(before.normal));
  return bend / (1.0 + lengths + 0.5 * lengths * lengths);
}

/// The covariance of all residuals together.
Eigen::MatrixXd dense_covariance(const std::vector<Point>& points, const MapError& error) {
  const auto size = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd covariance(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    double shared = error.offset_sigma_m * error.offset_sigma_m;
    for (Eigen::Index j = i; j < size; ++j) {
      const Point& point = points[static_cast<std::size_t>(j)];
      if (j > i) shared *= correlation(points[static_cast<std::size_t>(j) - 1], point, error);
      covariance(i, j) = covariance(j, i) =
          shared * points[static_cast<std::size_t>(i)].stretch * point.stretch;
    }
    covariance(i, i) += points[static_cast<std::size_t>(i)].variance;
  }
  return covariance;
}

Equations dense(const std::vector<Point>& points, const MapError& error) {
  const auto size = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd gradients(size, kParameters);
  Eigen::VectorXd residuals(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    gradients.row(i) = points[static_cast<std::size_t>(i)].gradient.transpose();
    residuals[i] = points[static_cast<std::size_t>(i)].residual;
  }
  const Eigen::LLT<Eigen::MatrixXd> root(dense_covariance(points, error));
  Equations equations;
  equations.information = gradients.transpose() * root.solve(gradients);
  equations.score = gradients.transpose() * root.solve(residuals);
  equations.chi_square = residuals.dot(root.solve(residuals));
  return equations;
}

/// Beams along walls that turn now and then, by corners or by a little; residuals so small that
/// none stands out.
std::vector<Point> along_walls(Random& random, int count) {
  std::vector<Point> points;
  Vector2d hit(3.0, -2.0);
  double bearing = 0.3;
  for (int i = 0; i < count; ++i) {
    if (random.chance(0.1)) bearing += random.uniform(-kPi, kPi);
    bearing += random.uniform(-0.1, 0.1);
    hit += random.uniform(0.01, 0.5) * unit_vector(bearing);
    Point point;
    point.hit = hit;
    point.normal = perpendicular(unit_vector(bearing));
    point.stretch = -1.0 / random.uniform(0.1, 1.0);
    const double sigma = random.uniform(0.01, 0.1);
    point.variance = sigma * sigma;
    point.residual = 0.2 * sigma * random.uniform(-1.0, 1.0);
    for (int k = 0; k < kParameters; ++k) point.gradient[k] = random.normal();
    points.push_back(point);
  }
  return points;
}

/// All of the information, of which sums keep the lower half.
template <int N>
typename NormalEquations<N>::Matrix information(const NormalEquations<N>& equations) {
  return equations.information.template selfadjointView<Eigen::Lower>();
}

void expect_equal(const Equations& one, const Equations& other) {
  EXPECT_LT((information(one) - information(other)).norm(), 1e-9 * information(other).norm());
  EXPECT_LT((one.score - other.score).norm(), 1e-9 * other.score.norm());
  EXPECT_NEAR(one.chi_square, other.chi_square, 1e-9 * other.chi_square);
}

TEST(OffsetWhitener, IsGeneralisedLeastSquaresWithTheFullCovariance) {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const std::vector<Point> points = along_walls(random, 1 + random.below(120));
    const MapError error{random.uniform(0.0, 0.3), random.uniform(0.1, 5.0), 0.0};
    expect_equal(whitened(points, error), dense(points, error));
  }
}

TEST(OffsetWhitener, WithoutOffsetsEachBeamSpeaksForItself) {
  Random random(2);
  const std::vector<Point> points = along_walls(random, 100);
  Equations alone;
  for (const Point& point : points) {
    alone.add(point.gradient, point.residual, 1.0 / point.variance);
  }
  expect_equal(whitened(points, {0.0, 1.5, 0.0}), alone);
}

/// So many beams on a wall, and then as many where it has turned by an angle.
Equations two_walls(double turn, double metres) {
  const MapError error{0.1, 1e6, 0.0};
  std::vector<Point> points(20);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].normal = i < 10 ? unit_vector(0.2) : unit_vector(0.2 + turn);
    points[i].hit = i < 10 ? Vector2d(0.0, 0.0) : Vector2d(metres, 0.0);
    points[i].stretch = -1.0;
    points[i].variance = 1e-6;
    points[i].gradient[0] = 1.0;
  }
  return whitened(points, error);
}

TEST(OffsetWhitener, ACornerEndsWhatIsShared) {
  const double one_offset = 1.0 / 0.01;  // ten beams on a wall are worth its one offset
  EXPECT_NEAR(two_walls(0.5 * kPi, 0.01).information(0, 0), 2.0 * one_offset, 0.01);
  EXPECT_NEAR(two_walls(kPi, 0.01).information(0, 0), 2.0 * one_offset, 0.01);
  EXPECT_NEAR(two_walls(0.0, 0.01).information(0, 0), one_offset, 0.01);
  EXPECT_LT(two_walls(0.2, 0.01).information(0, 0), 1.1 * one_offset);
}

TEST(OffsetWhitener, TheBeginningSharesNothingWithWhatIsNowhere) {
  const MapError error{0.1, 1e12, 0.0};
  Point point;
  point.normal = unit_vector(0.2);
  point.stretch = -2.0;
  point.variance = 0.01;
  point.gradient[0] = 1.0;
  EXPECT_DOUBLE_EQ(whitened({point}, error).information(0, 0), 1.0 / (0.01 + 4.0 * 0.01));
}

TEST(OffsetWhitener, ABeamThatIsGainsaidCountsLess) {
  // Huber's loss: from a few sigmas on the pull stays the same, however far the residual lies off.
  Point point;
  point.normal = Vector2d::UnitX();
  point.stretch = -1.0;
  point.variance = 0.01;
  point.gradient[0] = 1.0;
  const double sigma = std::sqrt(0.01 + 0.04);
  const auto score = [&](double sigmas) {
    point.residual = sigmas * sigma;
    return whitened({point}, {0.2, 1.0, 0.0}).score[0];
  };
  const double knee = score(1e6) * sigma;  // the residual in sigmas where that begins
  EXPECT_GT(knee, 1.0);
  EXPECT_LT(knee, 3.0);
  for (const double share : {0.1, 0.5, 0.99}) {
    EXPECT_NEAR(score(share * knee), share * knee / sigma, 1e-9);
    EXPECT_NEAR(score(-share * knee), -share * knee / sigma, 1e-9);
  }
  for (const double share : {1.01, 2.0, 50.0}) {
    EXPECT_NEAR(score(share * knee), knee / sigma, 1e-9);
    EXPECT_NEAR(score(-share * knee), -knee / sigma, 1e-9);
  }
}

TEST(OffsetWhitener, AnOutlierHardlyMovesWhatTheWallIsTakenFor) {
  Random random(3);
  std::vector<Point> points = along_walls(random, 40);
  const MapError error{0.1, 2.0, 0.0};
  const Equations clean = whitened(points, error);
  points[20].residual = 30.0;
  const Equations soiled = whitened(points, error);
  points[20].residual = 3000.0;
  // Past a few sigmas only its own constant pull is left.
  EXPECT_LT((whitened(points, error).score - soiled.score).norm(), 0.05 * soiled.score.norm());
  EXPECT_GT(soiled.chi_square, clean.chi_square);
}

TEST(NormalEquations, AddUp) {
  Random random(4);
  NormalEquations<3> all;
  NormalEquations<3> halves[2];
  for (int i = 0; i < 10; ++i) {
    const Vector3d gradient = test::drawn<3>([&] { return random.normal(); });
    const double residual = random.normal();
    all.add(gradient, residual, 0.5 + i);
    halves[i % 2].add(gradient, residual, 0.5 + i);
  }
  halves[0] += halves[1];
  EXPECT_LT((information(halves[0]) - information(all)).norm(), 1e-12);
  EXPECT_LT((halves[0].score - all.score).norm(), 1e-12);
  EXPECT_NEAR(halves[0].chi_square, all.chi_square, 1e-12);
}

}  // namespace
}  // namespace adit
