// Whether the tracker's covariance is what its errors are, when the map errs and scan after scan
// sees the same error.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <ostream>
#include <string>

#include "adit/simulation/random.hpp"
#include "adit/tracking/pose_tracker.hpp"
#include "support/draws.hpp"

namespace adit {
namespace {

constexpr int kRuns = 1000;
constexpr int kSteps = 150;
constexpr int kSettled = 20;  // scans until the first guess is forgotten

struct Course {
  const char* name = "";
  Pose2 step;  ///< from scan to scan
  Matrix3d noise = Matrix3d::Zero();
  Matrix3d bias = Matrix3d::Zero();
  OdometryNoise wheels;
  double bias_distance_m = 20.0;         ///< of the truth
  double stated_bias_distance_m = 20.0;  ///< that the tracker is told
};

void PrintTo(const Course& course, std::ostream* out) { *out << course.name; }

Matrix3d diagonal(double x, double y, double theta) {
  return Vector3d(x, y, theta).cwiseAbs2().asDiagonal();
}

Vector3d draw(const Matrix3d& covariance, Random& random) {
  const Matrix3d root = covariance.llt().matrixL();
  return root * test::drawn<3>([&] { return random.normal(); });
}

double nees(const PoseWithCovariance& estimate, const Pose2& truth) {
  const Vector3d error(truth.x - estimate.pose.x, truth.y - estimate.pose.y,
                       angle_between(estimate.pose.theta, truth.theta));
  return error.dot(estimate.covariance.inverse() * error) / 3.0;
}

/// Normalised squared error per degree of freedom, over runs in which the fixes share a bias that
/// changes with the way, and the wheels err as declared.
double mean_nees(const Course& course, std::uint64_t seed) {
  TrackingOptions options;
  options.bias_distance_m = course.stated_bias_distance_m;
  const Matrix3d step_error = move_covariance(course.step, course.wheels);
  const double way =
      course.step.translation().norm() + options.bias_lever_m * std::abs(course.step.theta);
  const double kept = std::exp(-way / course.bias_distance_m);
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    Random random(seed, static_cast<std::uint64_t>(run));
    Pose2 truth{0.0, 0.0, random.uniform(-kPi, kPi)};
    const Matrix3d first = diagonal(0.2, 0.2, 0.05);
    PoseTracker tracker;
    tracker.start({Pose2::from_vector(truth.vector() + draw(first, random)), first});
    Vector3d bias = draw(course.bias, random);
    for (int step = 0; step < kSteps; ++step) {
      truth = truth * course.step;
      const Pose2 reported = Pose2::from_vector(course.step.vector() + draw(step_error, random));
      tracker.predict(reported, course.wheels, options);
      bias = kept * bias + std::sqrt(1.0 - kept * kept) * draw(course.bias, random);
      PoseObservation fix;
      fix.pose = Pose2::from_vector(truth.vector() + bias + draw(course.noise, random));
      fix.information = (course.noise + course.bias).inverse();
      fix.noise_information = course.noise.inverse();
      tracker.update(fix, options);
      if (step >= kSettled) sum += nees(tracker.estimate(), truth);
    }
  }
  return sum / (kRuns * (kSteps - kSettled));
}

class Consistency : public testing::TestWithParam<Course> {};

TEST_P(Consistency, TheTrackerIsNeverSurerThanItsErrorsAllow) {
  const double per_dof = mean_nees(GetParam(), 13);
  EXPECT_LT(per_dof, 1.1);
  EXPECT_GT(per_dof, 0.75);
}

const Matrix3d kSmall = diagonal(0.01, 0.01, 0.001);
const Matrix3d kLarge = diagonal(0.06, 0.06, 0.006);
const Matrix3d kAlong = diagonal(0.2, 0.02, 0.006);
const Pose2 kStep{1.0, 0.0, 0.0};
const Pose2 kShort{0.2, 0.0, 0.0};
const Pose2 kLong{5.0, 0.0, 0.0};
const Pose2 kCurve{0.5, 0.0, 0.2};
const OdometryNoise kLoose;
const OdometryNoise kGood{0.01, 0.002, 0.01, 0.001, 0.0002};

INSTANTIATE_TEST_SUITE_P(
    Courses, Consistency,
    testing::Values(Course{"loose", kStep, kSmall, kLarge, kLoose},
                    Course{"loose_short", kShort, kSmall, kLarge, kLoose},
                    Course{"loose_long", kLong, kSmall, kLarge, kLoose},
                    Course{"loose_curve", kCurve, kSmall, kLarge, kLoose},
                    Course{"loose_noisy", kStep, kLarge, kSmall, kLoose},
                    Course{"loose_along", kCurve, kSmall, kAlong, kLoose},
                    Course{"good", kStep, kSmall, kLarge, kGood},
                    Course{"good_short", kShort, kSmall, kLarge, kGood},
                    Course{"good_short_noisy", kShort, kLarge, kLarge, kGood},
                    Course{"good_curve", kCurve, kSmall, kLarge, kGood},
                    Course{"good_along", kCurve, kSmall, kAlong, kGood},
                    Course{"changes_soon", kStep, kSmall, kLarge, kGood, 5.0, 5.0},
                    Course{"changes_late", kStep, kSmall, kLarge, kGood, 200.0, 200.0},
                    Course{"never_changes", kStep, kSmall, kLarge, kGood, 1e9, 1e9},
                    Course{"sooner_than_stated", kStep, kSmall, kLarge, kGood, 5.0, 20.0},
                    Course{"later_than_stated", kStep, kSmall, kLarge, kLoose, 1e9, 20.0}),
    [](const auto& course) { return std::string(course.param.name); });

}  // namespace
}  // namespace adit
