// The steady state of the cycle allocates nothing.
#include <gtest/gtest.h>

#include <memory>

#include "support/allocations.hpp"
#include "support/mockup_run.hpp"

namespace adit {
namespace {

/// Allocations of each turn of a run, by a localizer that has seen all of the run before.
template <typename Turn>
std::vector<long> allocations_of(Localizer& localizer, const PoseWithCovariance& start,
                                 std::size_t turns, const Turn& turn) {
  std::vector<long> counts(turns);
  for (const bool warm : {false, true}) {
    localizer.start(start.pose, start.covariance);
    for (std::size_t i = 0; i < turns; ++i) {
      const long before = test::allocations();
      turn(i);
      if (warm) counts[i] = test::allocations() - before;
    }
  }
  return counts;
}

/// Of a run from stop to stop.
std::vector<long> allocations_of(const Recording& recording, Localizer& localizer) {
  return allocations_of(localizer, recording.first_guess, recording.scans.size(),
                        [&](std::size_t i) {
                          const LaserScan& scan = recording.scans[i];
                          localizer.add_odometry({scan.stamp, recording.odometry[i]});
                          localizer.add_gyro(scan.stamp, recording.gyro[i]);
                          localizer.update(scan, recording.odometry[i]);
                        });
}

void expect_none(const std::vector<long>& counts) {
  EXPECT_FALSE(counts.empty());
  for (std::size_t i = 0; i < counts.size(); ++i) EXPECT_EQ(counts[i], 0) << "in turn " << i;
}

double metres_off(const Localizer& localizer, const Pose2& truth) {
  return (localizer.estimate().pose.translation() - truth.translation()).norm();
}

TEST(Allocation, TheCounterCounts) {
  const long before = test::allocations();
  const auto number = std::make_unique<int>(4);
  const std::vector<double> vector(static_cast<std::size_t>(100 + *number));
  EXPECT_GE(test::allocations(), before + 2);
  if (test::kCountsMalloc) {
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 + *number, 3);
    EXPECT_GE(test::allocations(), before + 3);
  }
  EXPECT_EQ(vector.size(), 104u);
}

TEST(Allocation, TheSteadyStateAllocatesNothing) {
  const LineMap map = LineMap::build(mockup().plan);
  const Recording recording = test::record_mockup(31100, 8);
  for (const Consistency consistency : {Consistency::clique, Consistency::paper}) {
    for (const Weighting weighting : {Weighting::covariance, Weighting::points}) {
      LocalizerSettings settings = test::mockup_settings();
      settings.matching.consistency = consistency;
      settings.estimation.weighting = weighting;
      Localizer localizer(map, settings);
      expect_none(allocations_of(recording, localizer));
    }
  }
}

// On the move: a scanner that takes its time, and the wheels at 50 Hz.
TEST(Allocation, ScansTakenOnTheMoveAllocateNothing) {
  const World world = test::cluttered_mockup(31101, 8);
  const LineMap map = LineMap::build(world.plan);
  ScannerSpec scanner = hokuyo();
  scanner.model.sweep_s = 0.1;
  scanner.model.stamp = SweepMoment::middle;
  DriveOptions drive;
  drive.speed_m_per_s = 2.0;
  const Recording recording = record_drive(world, world.path, scanner, drive, 31101);
  LocalizerSettings settings = test::mockup_settings();
  settings.scanner = scanner.model;
  Localizer localizer(map, settings);
  std::size_t fed = 0;
  std::size_t corrected = 0;
  const auto turn = [&](std::size_t i) {
    const LaserScan& scan = recording.scans[i];
    const double sweep_end = scan.stamp + 0.5 * scanner.model.sweep_s;
    if (i == 0) fed = corrected = 0;
    for (; fed < recording.wheels.size() && recording.wheels[fed].stamp <= sweep_end; ++fed) {
      localizer.add_odometry(recording.wheels[fed]);
    }
    localizer.update(scan);
    corrected += localizer.last_turn().scan_fit.correction.halves[0].vector().isZero() ? 0 : 1;
  };
  expect_none(allocations_of(localizer, recording.first_guess, recording.scans.size(), turn));
  EXPECT_GT(fed, 9 * recording.scans.size());        // ten for each scan
  EXPECT_GT(corrected, recording.scans.size() / 2);  // the sweep's motion was fitted
  EXPECT_LT(metres_off(localizer, recording.truth.back().pose), 0.2);
}

TEST(Allocation, TwoScannersAllocateNothing) {
  const World world = test::cluttered_mockup(31102, 8);
  const LineMap map = LineMap::build(world.plan);
  const RayCaster caster(world.walls);
  ScannerSpec front = sick_lms();
  front.vehicle_from_laser = {1.2, 0.0, 0.0};
  ScannerSpec rear = hokuyo();
  rear.vehicle_from_laser = {-0.8, 0.1, kPi};
  Random random(31102);
  std::vector<LaserScan> scans;
  for (const Pose2& stop : world.path) {
    for (const int which : {0, 1}) {
      LaserScan scan = simulate_scan(caster, stop, which == 0 ? front : rear, random);
      scan.stamp = 1.5 * static_cast<double>(scans.size());
      scan.scanner = which;
      scans.push_back(scan);
    }
  }
  LocalizerSettings settings = test::mockup_settings();
  settings.scanner = front.model;
  settings.more_scanners = {rear.model};
  Localizer localizer(map, settings);
  const PoseWithCovariance start{world.path[0], Vector3d(0.01, 0.01, 1e-3).asDiagonal()};
  const auto turn = [&](std::size_t i) {
    localizer.update(scans[i], world.path[i / 2]);
    EXPECT_LT(metres_off(localizer, world.path[i / 2]), 0.1) << "in turn " << i;
  };
  expect_none(allocations_of(localizer, start, scans.size(), turn));
}

TEST(Allocation, LearningTheMapsErrorAllocatesNothing) {
  const LineMap map = LineMap::build(mockup().plan);
  const Recording recording = test::record_mockup(31103, 8);
  LocalizerSettings settings = test::mockup_settings();
  settings.map = MapErrorOptions{};
  settings.map.is_stated = false;
  Localizer localizer(map, settings);
  const double unseen = localizer.last_turn().map_error.sigma_m();
  std::vector<long> counts = allocations_of(recording, localizer);
  counts.erase(counts.begin());  // a start forgets what was learnt, and with it one buffer
  expect_none(counts);
  EXPECT_LT(localizer.last_turn().map_error.sigma_m(), 0.7 * unseen);  // the plan is exact
}

// Buffers that one scan has grown serve the next, though it shows other features.
TEST(Allocation, FewScansGrowTheBuffers) {
  const LineMap map = LineMap::build(mockup().plan);
  Localizer localizer(map, test::mockup_settings());
  for (std::uint64_t seed = 31200; seed < 31210; ++seed) {
    const Recording recording = test::record_mockup(seed, 8);
    localizer.start(recording.first_guess.pose, recording.first_guess.covariance);
    long count = 0;
    for (std::size_t i = 0; i < recording.scans.size(); ++i) {
      const long before = test::allocations();
      localizer.update(recording.scans[i], recording.odometry[i]);
      count += test::allocations() - before;
    }
    if (seed >= 31208) {
      EXPECT_LE(count, 4) << "in the run of seed " << seed;
    }
  }
}

}  // namespace
}  // namespace adit
