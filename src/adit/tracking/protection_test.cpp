#include "adit/tracking/protection.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "adit/simulation/random.hpp"

namespace adit {
namespace {

/// Covariance of a position with these sigmas on axes turned by an angle (rad).
Matrix3d covariance(double major, double minor, double turn) {
  Matrix2d axes;
  axes.col(0) = unit_vector(turn);
  axes.col(1) = perpendicular(unit_vector(turn));
  Matrix3d result = Matrix3d::Identity();
  const Vector2d sigmas(major, minor);
  result.topLeftCorner<2, 2>() = axes * sigmas.cwiseAbs2().asDiagonal() * axes.transpose();
  return result;
}

TEST(RadiusOf, ACircleIsTheRayleighDistribution) {
  for (const double risk : {0.1, 1e-2, 1e-3, 1e-5}) {
    EXPECT_NEAR(radius_of(covariance(0.4, 0.4, 0.0), risk), 0.4 * std::sqrt(-2.0 * std::log(risk)),
                1e-12);
  }
}

TEST(RadiusOf, ALineIsTheTwoSidedNormal) {
  struct Quantile {
    double risk;
    double sigmas;
  };
  // 1 - risk / 2 of the standard normal distribution, from its tables.
  for (const Quantile& known :
       {Quantile{1e-2, 2.5758}, {1e-3, 3.2905}, {1e-4, 3.8906}, {1e-6, 4.8916}}) {
    const double radius = radius_of(covariance(0.4, 0.0, 0.7), known.risk);
    EXPECT_NEAR(radius / 0.4, known.sigmas, 0.02 * known.sigmas) << known.risk;
  }
}

TEST(RadiusOf, IsExceededAsOftenAsStated) {
  constexpr double kRisk = 1e-2;
  constexpr int kSamples = 200000;
  Random random(1);
  for (const double ratio : {0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 1.0}) {
    const double radius = radius_of(covariance(1.0, ratio, 0.4), kRisk);
    int beyond = 0;
    for (int i = 0; i < kSamples; ++i) {
      const double major = random.normal();
      const double minor = ratio * random.normal();
      beyond += std::hypot(major, minor) > radius ? 1 : 0;
    }
    // A few per cent of the radius are a quarter of the risk; it may only be the larger one.
    EXPECT_LT(beyond, 1.07 * kRisk * kSamples) << ratio;
    EXPECT_GT(beyond, 0.65 * kRisk * kSamples) << ratio;
  }
}

TEST(RadiusOf, MindsNeitherAxesNorUnitsNorHeading) {
  const double radius = radius_of(covariance(0.5, 0.2, 0.0), 1e-3);
  for (double turn = -3.0; turn < 3.0; turn += 0.3) {
    EXPECT_NEAR(radius_of(covariance(0.5, 0.2, turn), 1e-3), radius, 1e-9);
    EXPECT_NEAR(radius_of(100.0 * covariance(0.5, 0.2, turn), 1e-3), 10.0 * radius, 1e-8);
  }
  Matrix3d heading = covariance(0.5, 0.2, 0.0);
  heading.row(2) *= 7.0;
  heading.col(2) *= 7.0;
  EXPECT_NEAR(radius_of(heading, 1e-3), radius, 1e-12);
  EXPECT_EQ(radius_of(Matrix3d::Zero(), 1e-3), 0.0);
}

/// A room whose walls each show the position across them, and a little of the heading.
class Room {
 public:
  explicit Room(const Pose2& fitted_at, double prediction_sigma_m = 0.3) : fitted_at_(fitted_at) {
    prediction_.covariance =
        Vector3d(prediction_sigma_m, prediction_sigma_m, 0.05).cwiseAbs2().asDiagonal();
  }

  /// A wall whose normal points this way (rad); the plan has it off by so much (m).
  void add_wall(double bearing, double off) {
    const Vector3d gradient(std::cos(bearing), std::sin(bearing), 2.0 * std::sin(3.0 * bearing));
    const Vector3d from_fit = truth_.vector() - fitted_at_.vector();
    const double weight = 1.0 / (kSigma * kSigma);
    const int wall = static_cast<int>(walls_.size());
    walls_.push_back({wall, weight * gradient * gradient.transpose(),
                      weight * (gradient.dot(from_fit) + off) * gradient});
  }

  void set_prediction_error(const Vector3d& error) {
    prediction_.pose = Pose2::from_vector(truth_.vector() + error);
  }

  /// What all walls and the prediction say together.
  PoseWithCovariance estimate() const {
    const Matrix3d prior = prediction_.covariance.inverse();
    Matrix3d information = prior;
    Vector3d score = prior * (prediction_.pose.vector() - fitted_at_.vector());
    for (const WallEvidence& wall : walls_) {
      information += wall.information;
      score += wall.score;
    }
    const Matrix3d spread = information.inverse();
    return {Pose2::from_vector(fitted_at_.vector() + spread * score), spread};
  }

  double level(const ProtectionOptions& options = {}) const {
    Protection protection;
    return level(protection, options);
  }
  double level(Protection& protection, const ProtectionOptions& options = {}) const {
    return protection.update(estimate(), prediction_, fitted_at_, walls_, Matrix3d::Zero(),
                             options);
  }
  Vector3d error_vector() const { return difference(truth_, estimate().pose); }
  double error() const { return (estimate().pose.translation() - truth_.translation()).norm(); }

  static constexpr double kSigma = 0.05;

 private:
  Pose2 truth_{4.0, -2.0, 0.3};
  Pose2 fitted_at_;
  PoseWithCovariance prediction_{truth_, Matrix3d::Zero()};
  std::vector<WallEvidence> walls_;
};

const Pose2 kFittedAt{4.03, -2.02, 0.31};

TEST(ProtectionLevel, WithoutWallsIsTheCovariancesRadius) {
  const Room empty(kFittedAt);
  const ProtectionOptions options;
  EXPECT_DOUBLE_EQ(empty.level(),
                   options.margin * radius_of(empty.estimate().covariance, options.risk));
}

TEST(ProtectionLevel, CoversAnyOneWallThatIsWrongByAMetre) {
  for (int wrong = 0; wrong < 12; ++wrong) {
    for (const double off : {-1.0, 1.0}) {
      Room room(kFittedAt);
      for (int i = 0; i < 12; ++i) {
        room.add_wall(0.2 + i * kPi / 6.0, i == wrong ? off : 0.0);
      }
      EXPECT_GT(room.error(), 0.1);
      EXPECT_GT(room.level(), room.error());
    }
  }
}

TEST(ProtectionLevel, IsExceededNoMoreOftenThanStated) {
  constexpr int kRooms = 20000;
  const ProtectionOptions options{.risk = 1e-2, .margin = 1.0};
  Random random(5);
  int exceeded = 0;
  for (int i = 0; i < kRooms; ++i) {
    Room room(kFittedAt);
    room.set_prediction_error(
        {0.3 * random.normal(), 0.3 * random.normal(), 0.05 * random.normal()});
    const int walls = 3 + random.below(6);
    const int wrong = random.below(walls);
    for (int wall = 0; wall < walls; ++wall) {
      const double off = wall == wrong ? random.uniform(-1.5, 1.5) : 0.0;
      const double noise = Room::kSigma * random.normal();
      room.add_wall(random.uniform(-kPi, kPi), off + noise);
    }
    exceeded += room.error() > room.level(options) ? 1 : 0;
  }
  EXPECT_LT(exceeded, options.risk * kRooms);
}

TEST(ProtectionLevel, GrowsWhereAWallIsTheOnlyOneOfItsDirection) {
  const auto level = [](int walls_across_x) {
    Room room(kFittedAt);
    for (int i = 0; i < walls_across_x; ++i) room.add_wall(0.1 * i, 0.0);
    for (int i = 0; i < 3; ++i) room.add_wall(0.1 * i + 0.5 * kPi, 0.0);
    return room.level();
  };
  EXPECT_GT(level(1), 1.8 * level(3));
}

TEST(ProtectionLevel, CoversAPredictionThatFollowedTheWrongWallBefore) {
  // Two walls for y and one for x, which lies off; the prediction has come half the way already.
  Room room(kFittedAt);
  room.set_prediction_error({0.5, 0.0, 0.0});
  room.add_wall(0.0, 1.0);
  for (const double bearing : {1.5, 1.7}) room.add_wall(bearing, 0.0);
  EXPECT_GT(room.error(), 0.5);
  EXPECT_GT(room.level({.risk = 1e-3, .margin = 1.0}), room.error());
  EXPECT_GT(room.level({.risk = 1e-3, .margin = 1.0, .loose_prior = 100.0}),
            room.level({.risk = 1e-3, .margin = 1.0, .loose_prior = 1.0}));
}

TEST(ProtectionLevel, RemembersTheWallThatThePredictionFollowed) {
  constexpr double kGoodDeadReckoning = 0.03;  // m
  Protection protection;
  Vector3d error = Vector3d::Zero();
  double level = 0.0;
  const auto scan = [&](std::initializer_list<double> bearings, double off) {
    Room room(kFittedAt, kGoodDeadReckoning);
    room.set_prediction_error(error);
    for (const double bearing : bearings) room.add_wall(bearing, bearing == 0.0 ? off : 0.0);
    level = room.level(protection, {.risk = 1e-3, .margin = 1.0});
    error = room.error_vector();
    EXPECT_GT(level, room.error());
  };
  // The only wall for x lies off by a metre, scan after scan, and dead reckoning is good.
  for (int i = 0; i < 20; ++i) scan({0.0, 1.5, 1.7}, 1.0);
  EXPECT_NEAR(error.head<2>().norm(), 1.0, 0.1);
  // It gets out of sight; nothing else shows x.
  for (int i = 0; i < 5; ++i) scan({1.5, 1.7, 1.9}, 0.0);
  const double doubtful = level;
  // Others do, and the doubt goes.
  for (int i = 0; i < 10; ++i) scan({0.0, 0.2, -0.2, 1.5, 1.7, 1.9}, 0.0);
  EXPECT_LT(level, 0.3 * doubtful);
}

TEST(ProtectionLevel, GrowsWithLessRiskAndMoreMargin) {
  Room room(kFittedAt);
  for (int i = 0; i < 5; ++i) room.add_wall(1.3 * i, 0.1);
  const double level = room.level({.risk = 1e-3, .margin = 1.0});
  EXPECT_GT(room.level({.risk = 1e-4, .margin = 1.0}), level);
  // The way to the fit without a wall is known: only radii grow.
  const double wider = room.level({.risk = 1e-3, .margin = 1.5});
  EXPECT_GT(wider, level);
  EXPECT_LT(wider, 1.5 * level);
  EXPECT_NEAR(room.level({.risk = 1e-3, .margin = 2.0}) - wider, wider - level, 1e-9);
}

TEST(ProtectionLevel, MindsOnlyDifferencesOfHeadings) {
  // A place that hangs on the heading, so that a heading off by a turn would show in metres.
  Matrix3d prior = covariance(0.1, 0.1, 0.0);
  prior(0, 2) = prior(2, 0) = 0.09;
  const WallEvidence wall{0, 100.0 * Matrix3d::Identity(), Vector3d(1.0, 2.0, 3.0)};
  const std::vector<WallEvidence> walls(2, wall);
  const auto level = [&](double heading) {
    const auto turned = [&](double by) { return Pose2{0.0, 0.0, wrap_angle(heading + by)}; };
    return Protection().update({turned(0.0), prior}, {turned(0.02), prior}, turned(-0.01), walls,
                               Matrix3d::Zero(), {});
  };
  for (double heading = -kPi; heading < kPi; heading += 0.005) {
    ASSERT_NEAR(level(heading), level(0.0), 1e-9) << heading;
  }
}

}  // namespace
}  // namespace adit
