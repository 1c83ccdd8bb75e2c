#include "adit/survey/walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "adit/simulation/scanner.hpp"
#include "adit/simulation/world.hpp"
#include "adit/survey/visits.hpp"

namespace adit {
namespace {

std::vector<Segment> room(double width, double height) {
  const std::vector<Vector2d> corners{{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}};
  return outline(corners);
}

/// A drive along a line, looking all round, with poses that err by `pose_sigma` in metres.
struct Drive {
  Vector2d from;
  Vector2d to;
  int scans = 40;
  double pose_sigma = 0.0;
};

ScannerSpec all_round() {
  ScannerSpec spec = cyclone();
  spec.model.range_sigma_m = 0.01;
  spec.model.quantisation_m = 0.01;
  return spec;
}

std::vector<PosedScan> drive(const std::vector<Segment>& walls, const Drive& drive,
                             const std::vector<std::vector<Segment>>& moving = {}) {
  Random random(5);
  const RayCaster caster(walls);
  std::vector<PosedScan> scans;
  for (int i = 0; i < drive.scans; ++i) {
    const Vector2d at = drive.from + (drive.to - drive.from) * i / std::max(1, drive.scans - 1);
    const Pose2 truth{at.x(), at.y(), 0.1 * i};
    const std::span<const Segment> things =
        moving.empty() ? std::span<const Segment>{}
                       : std::span<const Segment>(moving[static_cast<std::size_t>(i)]);
    PosedScan posed{simulate_scan(caster, truth, all_round(), random, things), truth,
                    Matrix3d::Zero()};
    posed.map_from_vehicle.x += drive.pose_sigma * random.normal();
    posed.map_from_vehicle.y += drive.pose_sigma * random.normal();
    scans.push_back(std::move(posed));
  }
  return scans;
}

double farthest_from(const std::vector<Segment>& walls, const std::vector<Segment>& from) {
  double farthest = 0.0;
  for (const Segment& s : from) {
    for (const Vector2d& p : {s.a, s.b, Vector2d(0.5 * (s.a + s.b))}) {
      double least = 1e9;
      for (const Segment& w : walls) least = std::min(least, distance(w, p));
      farthest = std::max(farthest, least);
    }
  }
  return farthest;
}

TEST(SurveyWalls, FindsARoomAsOneClosedLine) {
  const auto walls = room(8.0, 6.0);
  const auto scans = drive(walls, {{2.0, 2.0}, {6.0, 4.0}});
  const WallMap map = survey_walls(scans, all_round().model);
  ASSERT_EQ(map.lines.size(), 1u);
  EXPECT_TRUE(map.lines[0].closed);
  EXPECT_EQ(map.lines[0].pieces.size(), 4u);
  EXPECT_LT(farthest_from(walls, map.segments()), 0.02);
  EXPECT_LT(farthest_from(map.segments(), walls), 0.02);
}

TEST(SurveyWalls, MakesOneWallOfLayersFromPosesThatErr) {
  const auto walls = room(8.0, 6.0);
  const auto scans = drive(walls, {{2.0, 2.0}, {6.0, 4.0}, 80, 0.04});
  const WallMap map = survey_walls(scans, all_round().model);
  ASSERT_EQ(map.lines.size(), 1u);
  EXPECT_LT(farthest_from(walls, map.segments()), 0.04);
  for (const SurveyedWall& piece : map.lines[0].pieces) {
    EXPECT_GT(piece.offset_sigma_m(), 0.002);
    EXPECT_LT(piece.offset_sigma_m(), 0.05);
    EXPECT_GE(piece.support.visits, 2);
  }
}

TEST(SurveyWalls, KeepsBothSidesOfAThinWall) {
  auto walls = room(10.0, 6.0);
  // 0.12 m thick, between two rooms that meet round its end.
  const auto thin =
      outline(std::vector<Vector2d>{{4.94, 0.0}, {4.94, 4.0}, {5.06, 4.0}, {5.06, 0.0}});
  walls.insert(walls.end(), thin.begin(), thin.end() - 1);
  auto scans = drive(walls, {{2.5, 1.0}, {2.5, 4.5}});
  const auto other = drive(walls, {{7.5, 4.5}, {7.5, 1.0}});
  scans.insert(scans.end(), other.begin(), other.end());
  const auto found = survey_walls(scans, all_round().model).segments();
  const auto side_at = [&](double x) {
    return std::any_of(found.begin(), found.end(), [&](const Segment& s) {
      return std::abs(s.a.x() - x) < 0.03 && std::abs(s.b.x() - x) < 0.03 && s.length() > 2.0;
    });
  };
  EXPECT_TRUE(side_at(4.94));
  EXPECT_TRUE(side_at(5.06));
}

TEST(SurveyWalls, DropsWhatMovesAndKeepsWhatStands) {
  auto walls = room(10.0, 6.0);
  const auto box = outline(std::vector<Vector2d>{{7.0, 3.5}, {8.0, 3.5}, {8.0, 4.5}, {7.0, 4.5}});
  std::vector<std::vector<Segment>> moving;
  for (int i = 0; i < 60; ++i) {
    // Walks along the drive and on, at a place of its own in every scan.
    const double x = 1.0 + 0.1 * i;
    moving.push_back(
        outline(std::vector<Vector2d>{{x, 4.0}, {x + 0.6, 4.0}, {x + 0.6, 4.6}, {x, 4.6}}));
  }
  auto standing = walls;
  standing.insert(standing.end(), box.begin(), box.end());
  const auto scans = drive(standing, {{1.0, 1.5}, {9.0, 1.5}, 60}, moving);
  const auto found = survey_walls(scans, all_round().model).segments();
  EXPECT_LT(farthest_from(standing, found), 0.05);
  EXPECT_LT(farthest_from(found, {{{7.1, 3.5}, {7.9, 3.5}}}), 0.05);
}

TEST(SurveyWalls, LeavesAnOpeningOpen) {
  // Two rooms and a doorway of 1.2 m between them, from x = 4 to 5.2.
  auto walls = room(10.0, 8.0);
  walls.push_back({{0.0, 4.0}, {4.0, 4.0}});
  walls.push_back({{5.2, 4.0}, {10.0, 4.0}});
  const auto scans = drive(walls, {{2.0, 2.0}, {8.0, 2.0}});
  const auto found = survey_walls(scans, all_round().model).segments();
  for (const Segment& s : found) EXPECT_GT(distance(s, {4.6, 4.0}), 0.45);
  const std::vector<Segment> partition{{{0.2, 4.0}, {3.9, 4.0}}, {{5.3, 4.0}, {9.8, 4.0}}};
  EXPECT_LT(farthest_from(found, partition), 0.05);
}

TEST(SurveyWalls, LetsWallsEndAtTheWallsTheyMeet) {
  // A partition that ends at the lower wall and in the open.
  auto walls = room(10.0, 6.0);
  walls.push_back({{5.0, 0.0}, {5.0, 3.0}});
  auto scans = drive(walls, {{2.0, 1.0}, {2.0, 5.0}, 40, 0.02});
  const auto other = drive(walls, {{8.0, 5.0}, {8.0, 1.0}, 40, 0.02});
  scans.insert(scans.end(), other.begin(), other.end());
  int sides = 0;
  for (const Segment& s : survey_walls(scans, all_round().model).segments()) {
    if (std::abs(s.a.x() - 5.0) > 0.1 || std::abs(s.b.x() - 5.0) > 0.1 || s.length() < 1.0) {
      continue;
    }
    ++sides;
    EXPECT_NEAR(std::min(s.a.y(), s.b.y()), 0.0, 0.04);
    EXPECT_NEAR(std::max(s.a.y(), s.b.y()), 3.0, 0.15);
  }
  EXPECT_EQ(sides, 2);
}

TEST(SurveyWalls, TakesWhatIsFarForWallsWhenSeveralVisitsOrScansMetIt) {
  const auto walls = room(30.0, 6.0);
  WallOptions options;
  options.sure_range_m = 10.0;
  const auto end_wall = [&](int scans, const std::vector<int>& visits) {
    const auto posed = drive(walls, {{3.0, 3.0}, {3.0, 3.0}, scans});
    for (const Segment& s : survey_walls(posed, all_round().model, options, visits).segments()) {
      if (s.a.x() > 29.0 && s.b.x() > 29.0) return true;
    }
    return false;
  };
  options.min_far_scans = 1000;
  EXPECT_FALSE(end_wall(10, std::vector<int>(10, 0)));
  EXPECT_TRUE(end_wall(10, {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}));
  options.min_far_scans = 6;
  EXPECT_TRUE(end_wall(10, std::vector<int>(10, 0)));
}

TEST(SurveyWalls, SaysNothingWithoutScans) {
  EXPECT_TRUE(survey_walls(std::vector<PosedScan>{}, ScannerModel{}).lines.empty());
}

TEST(SurveyWalls, GivesTheSameWallsTwice) {
  const auto scans = drive(room(8.0, 6.0), {{2.0, 2.0}, {6.0, 4.0}, 30, 0.03});
  const auto a = survey_walls(scans, all_round().model).segments();
  const auto b = survey_walls(scans, all_round().model).segments();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].a, b[i].a);
    EXPECT_EQ(a[i].b, b[i].b);
  }
}

std::vector<int> visits_of(const std::vector<PosedScan>& scans) {
  Visits visits({}, 2.0);
  std::vector<int> out;
  for (const PosedScan& scan : scans) out.push_back(visits.next(scan.map_from_vehicle));
  return out;
}

TEST(Visits, BeginAfterAStretchOfWayNotOfTime) {
  std::vector<PosedScan> scans(5);
  scans[3].map_from_vehicle.x = 2.5;
  scans[4].map_from_vehicle.x = 5.0;
  EXPECT_EQ(visits_of(scans), (std::vector<int>{0, 0, 0, 1, 2}));
}

TEST(Visits, AreNotMadeByTheJitterOfAMachineThatStands) {
  Random random(3);
  std::vector<PosedScan> scans(5000);
  for (PosedScan& scan : scans) {
    scan.map_from_vehicle = {0.03 * random.normal(), 0.03 * random.normal(), 0.0};
  }
  scans.back().map_from_vehicle.x = 2.5;
  const std::vector<int> visits = visits_of(scans);
  EXPECT_EQ(visits[4998], 0);
  EXPECT_EQ(visits[4999], 1);
}

}  // namespace
}  // namespace adit
