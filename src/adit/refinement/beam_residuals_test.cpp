#include "adit/refinement/beam_residuals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "adit/simulation/random.hpp"
#include "support/ascii_map.hpp"
#include "support/casting.hpp"

namespace adit {
namespace {

using testing::cast_at;
using testing::map_of;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Hit {
  double range = kInfinity;
  int wall = -1;
};

/// The nearest wall by looking at all.
Hit cast(const LineMap& map, const Pose2& laser, double bearing) {
  const Vector2d direction = unit_vector(laser.theta + bearing);
  Hit hit;
  for (std::size_t i = 0; i < map.walls().size(); ++i) {
    const double range = cast_at(map.walls()[i].segment, laser.translation(), direction);
    if (range < hit.range) hit = {range, static_cast<int>(i)};
  }
  return hit;
}

/// A drawing of rock, turned away from the axes.
LineMap turned(const test::AsciiMap& drawing) {
  const Pose2 turn{5.0, -3.0, 0.4};
  std::vector<Segment> segments = drawing.plan();
  for (Segment& segment : segments) segment = {turn * segment.a, turn * segment.b};
  return map_of(segments);
}

/// The paper's corridors around a pillar, with the columns of one wall.
LineMap corridors() {
  return turned(test::AsciiMap(R"(
      ####################
      #.............######
      ##............######
      #..................#
      #..................#
      ##....#######......#
      #.....#######......#
      #.....#######......#
      ##....#######......#
      #..................#
      #..................#
      #.................##
      ####################)",
                               1.0));
}

LineMap panel() {
  return turned(test::AsciiMap(R"(
      ..............
      .##.###.##.##.
      .##.###.##.##.
      ..............
      .#.####.#####.
      .#.####.#####.
      ..............)",
                               5.0));
}

bool is_open(const LineMap& map, const Vector2d& place) {
  int crossings = 0;
  for (const Wall& wall : map.walls()) {
    if (distance(wall.segment, place) < 0.7) return false;
    crossings += cast_at(wall.segment, place, unit_vector(1.234)) < kInfinity ? 1 : 0;
  }
  return crossings % 2 == 1;
}

Pose2 random_pose(const LineMap& map, Random& random) {
  const Box& box = map.bounds();
  for (;;) {
    const double y = random.uniform(box.min.y(), box.max.y());
    const double x = random.uniform(box.min.x(), box.max.x());
    if (is_open(map, {x, y})) return {x, y, random.uniform(-kPi, kPi)};
  }
}

/// A scanner, how it is mounted, and how its vehicle drives.
struct Case {
  const char* name = "";
  int beams = 0;
  double first_bearing = 0.0;
  double bearing_step = 0.0;
  Pose2 vehicle_from_laser;
  Twist2 twist;
  SweepMoment stamp = SweepMoment::start;
};

void PrintTo(const Case& setting, std::ostream* out) { *out << setting.name; }

const Pose2 kMounting{0.4, -0.3, radians(25.0)};
const Twist2 kDrive{5.0, -0.5, radians(45.0)};

const Case kCases[] = {
    {"at_rest", 360, -kPi, radians(1.0), {}, {}},
    {"mounted", 360, -kPi, radians(1.0), kMounting, {}},
    {"clockwise", 271, radians(135.0), radians(-1.0), kMounting, {}},
    {"stamp_at_start", 360, -kPi, radians(1.0), kMounting, kDrive, SweepMoment::start},
    {"stamp_in_the_middle", 360, -kPi, radians(1.0), kMounting, kDrive, SweepMoment::middle},
    {"stamp_at_end", 271, radians(135.0), radians(-1.0), kMounting, kDrive, SweepMoment::end}};

bool moves(const Case& setting) { return setting.twist.vector().norm() > 0.0; }

ScannerModel scanner_of(const Case& setting) {
  ScannerModel scanner;
  scanner.range_sigma_m = 0.01;
  scanner.quantisation_m = 0.0;
  scanner.max_range_m = 60.0;
  scanner.sweep_s = moves(setting) ? 0.2 : 0.0;
  scanner.stamp = setting.stamp;
  return scanner;
}

Hit cast_beam(const LineMap& map, const Pose2& vehicle, const Case& setting, std::size_t beam) {
  const auto beams = static_cast<std::size_t>(setting.beams);
  const double tau = sweep_timing(scanner_of(setting), beams).at(beam);
  const Pose2 laser = vehicle * moved(setting.twist, tau) * setting.vehicle_from_laser;
  return cast(map, laser, setting.first_bearing + static_cast<double>(beam) * setting.bearing_step);
}

LaserScan perfect_scan(const LineMap& map, const Pose2& vehicle, const Case& setting) {
  LaserScan scan;
  scan.first_bearing = setting.first_bearing;
  scan.bearing_step = setting.bearing_step;
  scan.max_range = 60.0;
  scan.vehicle_from_laser = setting.vehicle_from_laser;
  for (int i = 0; i < setting.beams; ++i) {
    const Hit hit = cast_beam(map, vehicle, setting, static_cast<std::size_t>(i));
    scan.ranges.push_back(std::min(hit.range, scan.max_range));
  }
  return scan;
}

SweepPath path_of(const Case& setting) {
  const auto beams = static_cast<std::size_t>(setting.beams);
  return steady_path(setting.twist, sweep_timing(scanner_of(setting), beams), beams);
}

class OfScans : public ::testing::TestWithParam<Case> {};

/// Beams that lie off their walls by more than so many metres across them, of all.
double share_off(std::span<const BeamResidual> beams, double metres) {
  double off = 0.0;
  for (const BeamResidual& beam : beams) off += beam.residual / beam.stretch > metres ? 1.0 : 0.0;
  for (const BeamResidual& beam : beams) off += beam.residual / beam.stretch < -metres ? 1.0 : 0.0;
  return off / static_cast<double>(beams.size());
}

TEST_P(OfScans, APerfectScanHasNoResiduals) {
  const Case& setting = GetParam();
  Random random(1);
  BeamResiduals residuals;
  for (const LineMap& map : {corridors(), panel()}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Pose2 pose = random_pose(map, random);
      const LaserScan scan = perfect_scan(map, pose, setting);
      residuals.set_scan(scan, scanner_of(setting));
      residuals.compute(map, pose, path_of(setting), {}, {});
      ASSERT_GT(residuals.beams().size(), 0.95 * setting.beams);
      if (moves(setting)) {
        // From a station's middle the edges lie a little aside; the rest is the curve of the way.
        EXPECT_LT(share_off(residuals.beams(), 1e-3), 0.05);
        RefinementOptions fine;
        fine.station_spacing_m = 0.02;
        residuals.compute(map, pose, path_of(setting), {}, fine);
        EXPECT_LT(share_off(residuals.beams(), 2e-4), 0.02);
      } else {
        EXPECT_EQ(share_off(residuals.beams(), 1e-9), 0.0);
      }
    }
  }
}

TEST(MovingScan, TurningOnTheSpotChangesNoBeamsWall) {
  Random random(7);
  Case spinning = kCases[4];
  spinning.vehicle_from_laser = {};
  for (const double turn_rate : {radians(90.0), radians(-90.0)}) {
    spinning.twist = {0.0, 0.0, turn_rate};
    const LineMap map = panel();
    for (int trial = 0; trial < 10; ++trial) {
      const Pose2 pose = random_pose(map, random);
      const LaserScan scan = perfect_scan(map, pose, spinning);
      BeamResiduals residuals;
      residuals.set_scan(scan, scanner_of(spinning));
      residuals.compute(map, pose, path_of(spinning), {}, {});
      for (const BeamResidual& beam : residuals.beams()) {
        const auto index = static_cast<std::size_t>(beam.beam);
        EXPECT_EQ(beam.wall, cast_beam(map, pose, spinning, index).wall);
      }
    }
  }
}

TEST(MovingScan, ACorrectionIsMotionOnTopOfWhatIsKnown) {
  Random random(6);
  const LineMap map = corridors();
  const Case& setting = kCases[4];
  Case known = setting;
  known.twist = {4.6, -0.4, radians(42.0)};
  SweepCorrection correction;
  for (Twist2& half : correction.halves) half = {0.4, -0.1, radians(3.0)};
  const Pose2 pose = random_pose(map, random);
  const LaserScan scan = perfect_scan(map, pose, setting);
  BeamResiduals residuals;
  residuals.set_scan(scan, scanner_of(setting));
  residuals.compute(map, pose, path_of(known), {}, {});
  EXPECT_GT(share_off(residuals.beams(), 5e-3), 0.5);
  residuals.compute(map, pose, path_of(known), correction, {});
  EXPECT_LT(share_off(residuals.beams(), 5e-3), 0.05);
}

TEST(MovingScan, ShowsMotionThatIsNotKnown) {
  Random random(2);
  const LineMap map = corridors();
  const Pose2 pose = random_pose(map, random);
  for (const Case& setting : kCases) {
    if (!moves(setting)) continue;
    const LaserScan scan = perfect_scan(map, pose, setting);
    BeamResiduals residuals;
    residuals.set_scan(scan, scanner_of(setting));
    residuals.compute(map, pose, {}, {}, {});
    EXPECT_GT(share_off(residuals.beams(), 0.02), 0.5) << setting.name;
  }
}

/// Numeric derivative of the range; nothing where another wall comes into the beam's way.
std::optional<Vector3d> numeric_gradient(const LineMap& map, const Pose2& pose, const Case& setting,
                                         const BeamResidual& beam) {
  constexpr double kStep = 1e-6;
  Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d step = kStep * Vector3d::Unit(axis);
    const auto index = static_cast<std::size_t>(beam.beam);
    const Hit up = cast_beam(map, Pose2::from_vector(pose.vector() + step), setting, index);
    const Hit down = cast_beam(map, Pose2::from_vector(pose.vector() - step), setting, index);
    if (up.wall != beam.wall || down.wall != beam.wall) return std::nullopt;
    gradient[axis] = (up.range - down.range) / (2.0 * kStep);
  }
  return gradient;
}

TEST_P(OfScans, TheGradientIsTheDerivativeOfTheRange) {
  const Case& setting = GetParam();
  // Within a station the way counts as straight; so short ones leave next to nothing of that.
  RefinementOptions options;
  options.station_spacing_m = 0.005;
  const double tolerance = moves(setting) ? 2e-3 : 1e-6;
  Random random(3);
  BeamResiduals residuals;
  int compared = 0;
  for (const LineMap& map : {corridors(), panel()}) {
    for (int trial = 0; trial < 10; ++trial) {
      const Pose2 pose = random_pose(map, random);
      const LaserScan scan = perfect_scan(map, pose, setting);
      residuals.set_scan(scan, scanner_of(setting));
      residuals.compute(map, pose, path_of(setting), {}, options);
      for (const BeamResidual& beam : residuals.beams()) {
        const auto numeric = numeric_gradient(map, pose, setting, beam);
        if (!numeric) continue;
        ++compared;
        // Flat beams bend: their range is less linear by the square of their stretch.
        ASSERT_LT((beam.gradient - *numeric).norm(),
                  tolerance * beam.stretch * beam.stretch * (1.0 + beam.range))
            << beam.beam;
      }
    }
  }
  EXPECT_GT(compared, 0.95 * 20 * setting.beams);
}

TEST_P(OfScans, EachBeamSaysWhatItMeets) {
  const Case& setting = GetParam();
  const double tolerance = moves(setting) ? 1e-3 : 1e-9;
  Random random(4);
  const LineMap map = panel();
  const Pose2 pose = random_pose(map, random);
  const LaserScan scan = perfect_scan(map, pose, setting);
  const auto beams = static_cast<std::size_t>(setting.beams);
  const SweepTiming timing = sweep_timing(scanner_of(setting), beams);
  BeamResiduals residuals;
  residuals.set_scan(scan, scanner_of(setting));
  residuals.compute(map, pose, path_of(setting), {}, {});
  int last = -1;
  for (const BeamResidual& beam : residuals.beams()) {
    ASSERT_GT(beam.beam, last);
    last = beam.beam;
    EXPECT_TRUE(beam.has_return);
    EXPECT_DOUBLE_EQ(beam.tau, timing.at(static_cast<std::size_t>(beam.beam)));
    const Pose2 vehicle = pose * moved(setting.twist, beam.tau) * moved({}, beam.tau);
    const Vector2d origin = (vehicle * setting.vehicle_from_laser).translation();
    const Segment& wall = map.walls()[static_cast<std::size_t>(beam.wall)].segment;
    const Vector2d along = (wall.b - wall.a).normalized();
    EXPECT_NEAR(cross(along, beam.hit - wall.a), 0.0, 1e-9);
    EXPECT_NEAR((beam.hit - origin).norm(), beam.range, tolerance);
    EXPECT_NEAR(std::abs(cross(along, beam.normal)), 1.0, 1e-12);
    EXPECT_NEAR(beam.normal.dot(beam.direction) * beam.stretch, 1.0, 1e-9);
    EXPECT_LE(beam.stretch, -1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(BeamResiduals, OfScans, ::testing::ValuesIn(kCases),
                         [](const auto& setting) { return std::string(setting.param.name); });

TEST(BeamStride, TakesEverySoManyBeams) {
  const LineMap map = panel();
  Random random(5);
  const Pose2 pose = random_pose(map, random);
  const LaserScan scan = perfect_scan(map, pose, kCases[0]);
  BeamResiduals residuals;
  residuals.set_scan(scan, scanner_of(kCases[0]));
  residuals.compute(map, pose, {}, {}, {}, 7);
  EXPECT_GT(residuals.beams().size(), 45u);
  for (const BeamResidual& beam : residuals.beams()) {
    EXPECT_EQ(beam.beam % 7, 0);
    EXPECT_NEAR(beam.residual, 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace adit
