#include "adit/refinement/map_error.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "adit/simulation/random.hpp"

namespace adit {
namespace {

constexpr double kSpacing = 0.05;  // m of wall between two beams
constexpr double kWall = 10.0;     // m

ScannerModel scanner() {
  ScannerModel model;
  model.range_sigma_m = 0.02;
  model.quantisation_m = 0.0;
  return model;
}

/// Offsets of points along a wall: an Ornstein-Uhlenbeck process and what each has for itself.
std::vector<double> draw_offsets(const MapError& truth, int points, Random& random) {
  const double kept = std::exp(-kSpacing / truth.length_m);
  double shared = truth.offset_sigma_m * random.normal();
  std::vector<double> offsets;
  for (int i = 0; i < points; ++i) {
    offsets.push_back(shared + truth.roughness_sigma_m * random.normal());
    shared = kept * shared + std::sqrt(1.0 - kept * kept) * truth.offset_sigma_m * random.normal();
  }
  return offsets;
}

/// The beams that meet a wall, as a fit that hit the truth leaves them.
void add_wall(const Pose2& map_from_wall, double metres, const MapError& truth, Random& random,
              std::vector<BeamResidual>& beams) {
  const int points = static_cast<int>(metres / kSpacing);
  const std::vector<double> offsets = draw_offsets(truth, points, random);
  for (int i = 0; i < points; ++i) {
    BeamResidual beam;
    beam.hit = map_from_wall * Vector2d(kSpacing * i, 0.0);
    beam.normal = perpendicular(unit_vector(map_from_wall.theta));
    beam.direction = -beam.normal;
    beam.stretch = -1.0 / (0.6 + 0.4 * std::cos(0.01 * i));
    beam.range = 6.0;
    beam.has_return = true;
    beam.gradient.head<2>() = beam.stretch * -beam.normal;
    beam.gradient.z() = kSpacing * i * beam.stretch;
    beam.residual = beam.stretch * offsets[static_cast<std::size_t>(i)] +
                    scanner().beam_sigma_m() * random.normal();
    beams.push_back(beam);
  }
}

std::vector<BeamResidual> room(const MapError& truth, Random& random) {
  std::vector<BeamResidual> beams;
  for (int wall = 0; wall < 4; ++wall) {
    add_wall({0.0, 0.0, 0.3 + 0.5 * kPi * wall}, kWall, truth, random, beams);
  }
  return beams;
}

/// Looks at rooms in turn whose walls are seen from near and from far; those of a bent plan lie off
/// by more where they are far.
void show_near_and_far(MapErrorEstimator& estimator, int rooms, const MapError& truth,
                       Random& random) {
  for (int i = 0; i < rooms; ++i) {
    const double range = random.uniform(1.0, 12.0);
    MapError here = truth;
    here.offset_sigma_m = truth.offset_sigma_at(range);
    std::vector<BeamResidual> beams = room(here, random);
    for (BeamResidual& beam : beams) beam.range = range;
    estimator.add(beams, std::vector<double>(beams.size(), 1.0), scanner(), Matrix3d::Zero());
  }
}

void show_rooms(MapErrorEstimator& estimator, int rooms, const MapError& truth, Random& random) {
  for (int i = 0; i < rooms; ++i) {
    const std::vector<BeamResidual> beams = room(truth, random);
    estimator.add(beams, std::vector<double>(beams.size(), 1.0), scanner(), Matrix3d::Zero());
  }
}

const MapErrorOptions kOptions{.sigma_m = 0.05,
                               .length_m = 1.5,
                               .roughness_share = 0.02,
                               .prior_metres = 20.0,
                               .memory_metres = 3000.0};

class Truths : public ::testing::TestWithParam<MapError> {};

TEST_P(Truths, AreLearntFromTheResiduals) {
  const MapError truth = GetParam();
  Random random(1);
  MapErrorEstimator estimator(kOptions);
  show_rooms(estimator, 400, truth, random);
  const MapError& learnt = estimator.error();
  // An offset is taken for larger than it looks: the largest are lost to clutter on a real map.
  EXPECT_GT(learnt.offset_sigma_m, 0.95 * truth.offset_sigma_m);
  EXPECT_LT(learnt.offset_sigma_m, 1.2 * truth.offset_sigma_m);
  EXPECT_NEAR(learnt.length_m, truth.length_m, 0.2 * truth.length_m);
  // By how much an offset changes within the cells that are averaged, it counts as roughness.
  EXPECT_GT(learnt.roughness_sigma_m, 0.9 * truth.roughness_sigma_m);
  EXPECT_LT(learnt.roughness_sigma_m,
            std::hypot(truth.roughness_sigma_m, 0.4 * truth.offset_sigma_m));
}

INSTANTIATE_TEST_SUITE_P(MapError, Truths,
                         ::testing::Values(MapError{0.15, 1.5, 0.03}, MapError{0.05, 1.0, 0.02},
                                           MapError{0.05, 2.5, 0.0}, MapError{0.3, 0.8, 0.1}));

/// Every so many beams only: their ends lie farther apart than the cells are long.
TEST(MapErrorEstimator, LearnsTheLengthWhereBeamsEndFarApart) {
  const MapError truth{0.1, 1.5, 0.02};
  for (const std::size_t every : {1U, 6U, 8U, 9U}) {
    MapErrorEstimator estimator(kOptions);
    Random random(12);
    for (int i = 0; i < 300; ++i) {
      const std::vector<BeamResidual> all = room(truth, random);
      std::vector<BeamResidual> some;
      for (std::size_t k = 0; k < all.size(); k += every) some.push_back(all[k]);
      estimator.add(some, std::vector<double>(some.size(), 1.0), scanner(), Matrix3d::Zero());
    }
    EXPECT_NEAR(estimator.error().length_m, truth.length_m, 0.25) << every;
    EXPECT_NEAR(estimator.error().offset_sigma_m, truth.offset_sigma_m, 0.015) << every;
  }
}

TEST(MapErrorEstimator, LearnsHowMuchAPlanBends) {
  Random random(7);
  const MapError truth{0.03, 1.5, 0.0, 0.006};
  MapErrorEstimator estimator(kOptions);
  show_near_and_far(estimator, 800, truth, random);
  const MapError& learnt = estimator.error();
  EXPECT_NEAR(learnt.distortion_ratio, truth.distortion_ratio, 0.2 * truth.distortion_ratio);
  EXPECT_NEAR(learnt.offset_sigma_m, truth.offset_sigma_m, 0.25 * truth.offset_sigma_m);
  EXPECT_NEAR(learnt.length_m, truth.length_m, 0.25 * truth.length_m);
}

TEST(MapErrorEstimator, SeesNoBendWhereThereIsNone) {
  Random random(8);
  const MapError truth{0.1, 1.5, 0.0};
  MapErrorEstimator estimator(kOptions);
  show_near_and_far(estimator, 800, truth, random);
  EXPECT_LT(estimator.error().distortion_ratio * 6.0, 0.35 * truth.offset_sigma_m);
  EXPECT_GT(estimator.error().offset_sigma_m, 0.9 * truth.offset_sigma_m);
}

TEST(MapErrorEstimator, LearnsThatAMapIsRight) {
  Random random(2);
  MapErrorEstimator estimator(kOptions);
  show_rooms(estimator, 400, {0.0, 1.5, 0.0}, random);
  // What is left is the part of what was stated that is not outweighed.
  const double left = kOptions.sigma_m * std::sqrt(kOptions.prior_metres / kOptions.memory_metres);
  EXPECT_LT(estimator.error().offset_sigma_m, 1.5 * left);
  EXPECT_LT(estimator.error().roughness_sigma_m, 1.5 * left);
}

TEST(MapErrorEstimator, BelievesWhatIsStatedBeforeItHasSeenAnything) {
  const MapErrorOptions options{
      .sigma_m = 0.12, .length_m = 2.0, .roughness_share = 0.1, .prior_metres = 20.0};
  const MapErrorEstimator estimator(options);
  const MapError& error = estimator.error();
  EXPECT_NEAR(error.sigma_m(), 0.12, 0.15 * 0.12);
  EXPECT_NEAR(error.length_m, 2.0, 0.1 * 2.0);
  EXPECT_NEAR(error.roughness_sigma_m, std::sqrt(0.1) * 0.12, 0.1 * 0.12);
  MapErrorEstimator shown(options);
  shown.add({}, {}, scanner(), Matrix3d::Zero());
  EXPECT_EQ(shown.error().offset_sigma_m, error.offset_sigma_m);
}

TEST(MapErrorEstimator, AFewMetresCountLessThanWhatIsStated) {
  const auto learnt_after = [](int rooms, double prior_metres) {
    Random random(3);
    MapErrorOptions options = kOptions;
    options.prior_metres = prior_metres;
    MapErrorEstimator estimator(options);
    show_rooms(estimator, rooms, {0.2, 1.5, 0.0}, random);
    return estimator.error().offset_sigma_m;
  };
  EXPECT_NEAR(learnt_after(1, 4000.0), 0.05, 0.015);
  EXPECT_GT(learnt_after(20, 10.0), 0.15);
  EXPECT_LT(learnt_after(20, 4000.0), 0.12);
}

TEST(MapErrorEstimator, ForgetsAMapThatItHasLeft) {
  Random random(4);
  MapErrorOptions options = kOptions;
  options.memory_metres = 500.0;
  MapErrorEstimator estimator(options);
  show_rooms(estimator, 100, {0.2, 1.5, 0.0}, random);
  EXPECT_GT(estimator.error().offset_sigma_m, 0.15);
  show_rooms(estimator, 75, {0.02, 1.5, 0.0}, random);  // six times what it remembers
  EXPECT_LT(estimator.error().offset_sigma_m, 0.04);
}

TEST(MapErrorEstimator, BeamsThatMetNoWallTeachNothing) {
  Random random(5);
  MapErrorEstimator one;
  MapErrorEstimator other;
  std::vector<BeamResidual> beams = room({0.1, 1.5, 0.02}, random);
  std::vector<double> on_wall(beams.size(), 1.0);
  one.add(beams, on_wall, scanner(), Matrix3d::Zero());
  for (std::size_t i = 0; i < beams.size(); i += 40) {
    BeamResidual dust = beams[i];
    dust.residual -= 3.0;
    beams.insert(beams.begin() + static_cast<std::ptrdiff_t>(i), dust);
    on_wall.insert(on_wall.begin() + static_cast<std::ptrdiff_t>(i), 0.001);
  }
  other.add(beams, on_wall, scanner(), Matrix3d::Zero());
  EXPECT_EQ(one.error().offset_sigma_m, other.error().offset_sigma_m);
  EXPECT_EQ(one.error().roughness_sigma_m, other.error().roughness_sigma_m);
}

/// The residuals that a fit of place and heading leaves, and its covariance: generalised least
/// squares with the full covariance of all beams.
struct Fitted {
  std::vector<BeamResidual> beams;
  Matrix3d covariance = Matrix3d::Zero();
};

Fitted fit(std::vector<BeamResidual> beams, const MapError& truth) {
  const auto size = static_cast<Eigen::Index>(beams.size());
  const auto at = [&](Eigen::Index i) -> BeamResidual& {
    return beams[static_cast<std::size_t>(i)];
  };
  Eigen::MatrixXd covariance(size, size);
  Eigen::MatrixXd gradients(size, 2);  // across the wall, and the turn: the way along it is open
  Eigen::VectorXd residuals(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) {
      const double metres = (at(i).hit - at(j).hit).norm();
      covariance(i, j) = at(i).stretch * at(j).stretch * truth.offset_sigma_m *
                         truth.offset_sigma_m * std::exp(-metres / truth.length_m);
    }
    covariance(i, i) += scanner().range_sigma_m * scanner().range_sigma_m;
    gradients.row(i) = at(i).gradient.tail<2>().transpose();
    residuals[i] = at(i).residual;
  }
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  const Matrix2d spread = Matrix2d(gradients.transpose() * root.solve(gradients)).inverse();
  const Vector2d step = spread * (gradients.transpose() * root.solve(residuals));
  for (Eigen::Index i = 0; i < size; ++i) at(i).residual -= gradients.row(i).dot(step);
  Fitted fitted{std::move(beams), Matrix3d::Zero()};
  fitted.covariance.bottomRightCorner<2, 2>() = spread;
  return fitted;
}

TEST(MapErrorEstimator, PutsBackWhatTheFitTookOut) {
  // A single short wall: the fit takes its mean offset and its turn for those of the pose.
  const MapError truth{0.1, 1.5, 0.0};
  Random random(6);
  MapErrorEstimator with(kOptions);
  MapErrorEstimator without(kOptions);
  for (int i = 0; i < 1500; ++i) {
    std::vector<BeamResidual> beams;
    add_wall({}, 3.0, truth, random, beams);
    const Fitted fitted = fit(beams, truth);
    const std::vector<double> on_wall(beams.size(), 1.0);
    with.add(fitted.beams, on_wall, scanner(), fitted.covariance);
    without.add(fitted.beams, on_wall, scanner(), Matrix3d::Zero());
  }
  EXPECT_GT(with.error().offset_sigma_m, 0.92 * truth.offset_sigma_m);
  EXPECT_LT(with.error().offset_sigma_m, 1.2 * truth.offset_sigma_m);
  EXPECT_LT(without.error().offset_sigma_m, 0.8 * truth.offset_sigma_m);
}

TEST(MapError, OfAPointIsOffsetAndRoughnessTogether) {
  EXPECT_DOUBLE_EQ((MapError{0.3, 1.0, 0.4}).sigma_m(), 0.5);
}

}  // namespace
}  // namespace adit
