// A map, a scan, a question.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <string>

#include "adit/localizer/localizer.hpp"
#include "adit/simulation/scanner.hpp"
#include "adit/simulation/world.hpp"
#include "support/ascii_map.hpp"

namespace adit {
namespace {

using test::AsciiMap;

constexpr double kCell = 2.0;

// Corridors 4 m wide.
const AsciiMap& crossing() {
  static const AsciiMap mine(R"(
    ##########..######
    ##########..######
    ##########..######
    #.........C......#
    #...............E#
    ##########..######
    ##########..######
    ##########..######)",
                             kCell);
  return mine;
}

class Machine {
 public:
  explicit Machine(const AsciiMap& mine, ScannerSpec spec = sick(), std::uint64_t seed = 1)
      : plan_(mine.plan()),
        map_(LineMap::build(plan_)),
        caster_(mine.solid()),
        spec_(spec),
        random_(seed),
        localizer_(map_, settings_for(spec)) {}

  void start(const Pose2& guess) { localizer_.start(guess); }

  /// Stands at a pose and has its odometry say another.
  Estimate stand(const Pose2& truth, const Pose2& odometry) {
    LaserScan scan = simulate_scan(caster_, truth, spec_, random_, people);
    scan.stamp = stamp_++;
    return localizer_.update(scan, odometry);
  }
  Estimate stand(const Pose2& truth) { return stand(truth, truth); }

  std::vector<Segment> people;

 private:
  static LocalizerSettings settings_for(const ScannerSpec& spec) {
    LocalizerSettings settings;
    settings.scanner = spec.model;
    settings.map.sigma_m = 0.0;
    return settings;
  }

  std::vector<Segment> plan_;
  LineMap map_;
  RayCaster caster_;
  ScannerSpec spec_;
  Random random_;
  Localizer localizer_;
  double stamp_ = 0.0;
};

Pose2 pose_at(const Vector2d& place, double heading_deg) {
  return {place.x(), place.y(), radians(heading_deg)};
}

double position_error(const Estimate& e, const Pose2& truth) {
  return (e.pose.translation() - truth.translation()).norm();
}

double heading_error_deg(const Estimate& e, const Pose2& truth) {
  return degrees(std::abs(angle_between(truth.theta, e.pose.theta)));
}

/// The error in sigmas of the claimed covariance.
double claimed_sigmas(const Estimate& e, const Pose2& truth) {
  const Vector3d error(e.pose.x - truth.x, e.pose.y - truth.y,
                       angle_between(truth.theta, e.pose.theta));
  return std::sqrt(error.dot(e.covariance.inverse() * error));
}

void expect_found(const Estimate& e, const Pose2& truth, double metres, double degrees) {
  EXPECT_EQ(e.status, Status::ok);
  EXPECT_LT(position_error(e, truth), metres);
  EXPECT_LT(heading_error_deg(e, truth), degrees);
  EXPECT_LT(claimed_sigmas(e, truth), 5.0);
}

// From a guess that is off by 20 cm and 2 degrees, on several headings.
void expect_found_at(const AsciiMap& mine, char place) {
  for (const double heading : {0.0, 70.0, 135.0, -160.0, -45.0}) {
    SCOPED_TRACE(heading);
    const Pose2 truth = pose_at(mine.at(place) + Vector2d(0.3, -0.4), heading);
    Machine machine(mine);
    machine.start({truth.x + 0.15, truth.y - 0.13, truth.theta + radians(2.0)});
    expect_found(machine.stand(truth), truth, 0.03, 0.3);
  }
}

TEST(Scenario, ACrossing) { expect_found_at(crossing(), 'C'); }

TEST(Scenario, ADeadEnd) { expect_found_at(crossing(), 'E'); }

TEST(Scenario, ATJunction) {
  const AsciiMap mine(R"(
    ####################
    #..................#
    #........T.........#
    #########..#########
    #########..#########
    #########..#########
    #########..#########)",
                      kCell);
  expect_found_at(mine, 'T');
}

TEST(Scenario, RoomsAndPillars) {
  const AsciiMap mine(R"(
    #####################
    #...................#
    #.P.................#
    #..###..####..####..#
    #..###..####..####..#
    #..###..####..####..#
    #...................#
    #.........Q.........#
    #..####..####..###..#
    #..####..####..###..#
    #...................#
    #####################)",
                      kCell);
  expect_found_at(mine, 'P');
  expect_found_at(mine, 'Q');
}

// 400 m without a feature: its end walls are out of range.
TEST(Scenario, AlongAFeaturelessCorridorOnlyOdometryTells) {
  const std::string row = "#" + std::string(100, '.') + "#\n";
  const AsciiMap corridor(row, 4.0);
  const Vector2d middle(200.0, 2.0);
  Machine machine(corridor);
  machine.start(pose_at(middle, 0.0));
  double last_variance = 0.0;
  for (int i = 0; i <= 20; ++i) {
    SCOPED_TRACE(i);
    const Pose2 truth{middle.x() + 1.0 * i, middle.y() + 0.3 * std::sin(0.5 * i), radians(2.0 * i)};
    // The wheels report 5 % too much.
    const Pose2 odometry{1.05 * 1.0 * i, truth.y, truth.theta};
    const Estimate e = machine.stand(truth, odometry);
    EXPECT_FALSE(e.dead_reckoned);
    EXPECT_LT(std::abs(e.pose.y - truth.y), 0.02);
    EXPECT_LT(heading_error_deg(e, truth), 0.2);
    EXPECT_LT(std::sqrt(e.covariance(1, 1)), 0.02);
    EXPECT_NEAR(e.pose.x - middle.x(), odometry.x, 0.02 + 0.01 * i);
    EXPECT_GT(e.covariance(0, 0), last_variance);
    EXPECT_LT(claimed_sigmas(e, truth), 5.0);
    last_variance = e.covariance(0, 0);
  }
  EXPECT_GT(std::sqrt(last_variance), 0.2);
}

TEST(Scenario, TheEndOfTheCorridorBringsBackWhatItTook) {
  const std::string row = "#" + std::string(100, '.') + "#\n";
  const AsciiMap corridor(row, 4.0);
  Machine machine(corridor);
  machine.start(pose_at({80.0, 2.0}, 180.0));
  for (int i = 0; i <= 60; ++i) {
    const Pose2 truth{80.0 - i, 2.0, kPi};
    const Estimate e = machine.stand(truth, {1.02 * i, 0.0, 0.0});
    if (i == 60) expect_found(e, truth, 0.03, 0.2);
  }
}

TEST(Scenario, PeopleInTheWay) {
  const Pose2 truth = pose_at(crossing().at('C'), 20.0);
  World crowd;
  for (const double azimuth : {-150.0, -95.0, -40.0, 5.0, 30.0, 60.0, 115.0, 170.0}) {
    const Vector2d place = truth.translation() + 1.6 * unit_vector(radians(azimuth));
    crowd.people.push_back({place, place, 0.0, 0.45});
  }
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    Machine machine(crossing(), sick(), seed);
    machine.people = people_at(crowd, 0.0);
    machine.start({truth.x - 0.1, truth.y + 0.15, truth.theta - radians(2.0)});
    expect_found(machine.stand(truth), truth, 0.05, 0.4);
  }
}

TEST(Scenario, AnObstacleThatHidesHalfTheView) {
  const AsciiMap mine(R"(
    ##########..######
    ##########..######
    ##########..######
    #.........C%.....#
    #...............E#
    ##########.%######
    ##########..######
    ##########..######)",
                      kCell);
  const Pose2 truth = pose_at(mine.at('C') + Vector2d(0.4, -0.4), 0.0);
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    Machine machine(mine, sick(), seed);
    machine.start({truth.x - 0.1, truth.y + 0.15, truth.theta - radians(2.0)});
    expect_found(machine.stand(truth), truth, 0.05, 0.4);
  }
}

TEST(Scenario, AStartOffByHalfAMetreAndFiveDegrees) {
  const Pose2 truth = pose_at(crossing().at('C') + Vector2d(0.2, -0.7), 30.0);
  for (int i = 0; i < 8; ++i) {
    const Vector2d off = 0.5 * unit_vector(kTwoPi * i / 8);
    const double turn = radians(i % 2 == 0 ? 5.0 : -5.0);
    for (const ScannerSpec& spec : {sick(), cyclone()}) {
      SCOPED_TRACE(i);
      Machine machine(crossing(), spec);
      machine.start({truth.x + off.x(), truth.y + off.y(), truth.theta + turn});
      const bool coarse = spec.model.range_sigma_m > 0.05;
      expect_found(machine.stand(truth), truth, coarse ? 0.15 : 0.03, coarse ? 1.0 : 0.3);
    }
  }
}

// The machine jumps by 0.3 m, unseen by its wheels: it may say that it is lost, never that all is
// well at the wrong place, and it finds back.
TEST(Scenario, AHop) {
  for (int direction = 0; direction < 8; ++direction) {
    const Vector2d hop = 0.3 * unit_vector(kTwoPi * direction / 8);
    Machine machine(crossing());
    const Vector2d begin = crossing().at('C') + Vector2d(-6.0, -0.8);
    machine.start(pose_at(begin, 0.0));
    Estimate e;
    for (int i = 0; i < 16; ++i) {
      SCOPED_TRACE(i);
      Pose2 truth = pose_at(begin + Vector2d(0.2 * i, 0.0), 0.0);
      const Pose2 odometry = truth;
      if (i >= 6) truth = {truth.x + hop.x(), truth.y + hop.y(), truth.theta};
      e = machine.stand(truth, odometry);
      if (e.status == Status::ok) {
        EXPECT_LT(position_error(e, truth), 0.05);
      }
      if (i < 6 || i > 11) {
        EXPECT_EQ(e.status, Status::ok);
      }
    }
  }
}

TEST(Scenario, AGuessAtTheWrongPlaceIsRefused) {
  const Pose2 truth = pose_at(crossing().at('E'), 90.0);
  Machine machine(crossing());
  machine.start(pose_at(crossing().at('C'), 90.0));
  EXPECT_EQ(machine.stand(truth).status, Status::lost);
}

}  // namespace
}  // namespace adit
