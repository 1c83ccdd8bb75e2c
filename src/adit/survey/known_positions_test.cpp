#include "adit/survey/known_positions.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "adit/simulation/mine_worlds.hpp"
#include "adit/simulation/tilted_scanner.hpp"

namespace adit {
namespace {

struct Stations {
  std::vector<Segment> walls;
  std::vector<PositionedScan> scans;
  std::vector<double> headings;
};

/// Two scans at each of eight stations of a rough panel, each scan with a heading of its own.
Stations stations_in_a_panel() {
  Stations out;
  PanelOptions options;
  options.rows = 2;
  options.columns = 2;
  options.path_step_m = 2.0;
  const World world = panel(options, 11);
  out.walls = world.walls;
  const RayCaster caster(world.walls);
  Random random(7);
  for (std::size_t s = 0; s < 8; ++s) {
    for (int k = 0; k < 2; ++k) {
      Pose2 pose = world.path[s];
      pose.theta = random.uniform(-kPi, kPi);
      const Tilt tilt{radians(1.0) * random.normal(), radians(1.0) * random.normal()};
      out.scans.push_back({simulate_tilted_scan(caster, pose, sick(), tilt, {}, random),
                           pose.translation(), std::nullopt});
      out.headings.push_back(pose.theta);
    }
  }
  return out;
}

std::vector<LaserScan> scans_at(const std::vector<double>& stamps) {
  std::vector<LaserScan> scans(stamps.size());
  for (std::size_t i = 0; i < stamps.size(); ++i) scans[i].stamp = stamps[i];
  return scans;
}

void expect_headings(const Stations& truth, const KnownPositionsSurvey& survey, double within) {
  for (std::size_t i = 0; i < truth.headings.size(); ++i) {
    EXPECT_LT(std::abs(angle_between(truth.headings[i], survey.scans[i].map_from_vehicle.theta)),
              within);
  }
}

/// How much wall was found (m); each must lie within `near_m` of a true one, or within three of its
/// own sigmas where it was seen from afar only.
double length_near_truth(const Stations& truth, const WallMap& walls, double near_m) {
  double length = 0.0;
  for (const SurveyedWallLine& line : walls.lines) {
    for (const SurveyedWall& piece : line.pieces) {
      const Segment& s = piece.segment;
      double least = 1e9;
      for (const Segment& w : truth.walls) {
        least = std::min(least, distance(w, 0.5 * (s.a + s.b)));
      }
      EXPECT_LT(least, std::max(near_m, 3.0 * piece.offset_sigma_m()))
          << "wall from " << s.a.transpose() << " to " << s.b.transpose();
      length += s.length();
    }
  }
  return length;
}

TEST(SurveyKnownPositions, FindsHeadingsAndWallsWithoutAnyHeadingGiven) {
  const Stations stations = stations_in_a_panel();
  const auto survey = survey_known_positions(stations.scans, sick().model);
  ASSERT_TRUE(survey.has_value());
  EXPECT_EQ(survey->stations.size(), 8u);
  expect_headings(stations, *survey, radians(0.5));
  for (std::size_t i = 0; i < stations.scans.size(); ++i) {
    EXPECT_EQ(survey->scans[i].map_from_vehicle.translation(), stations.scans[i].position);
  }
  EXPECT_GT(length_near_truth(stations, survey->walls, 0.15), 40.0);
}

TEST(SurveyKnownPositions, TakesPositionsThatErrByCentimetres) {
  Stations stations = stations_in_a_panel();
  Random random(3);
  for (std::size_t i = 0; i < stations.scans.size(); i += 2) {
    const Vector2d error(0.03 * random.normal(), 0.03 * random.normal());
    stations.scans[i].position += error;
    stations.scans[i + 1].position += error;
  }
  const auto survey = survey_known_positions(stations.scans, sick().model);
  ASSERT_TRUE(survey.has_value());
  expect_headings(stations, *survey, radians(1.0));
  EXPECT_GT(length_near_truth(stations, survey->walls, 0.25), 40.0);
}

TEST(SurveyKnownPositions, KeepsNearTheHeadingsThatAreGiven) {
  Stations stations = stations_in_a_panel();
  for (std::size_t i = 0; i < stations.scans.size(); ++i) {
    stations.scans[i].heading = stations.headings[i] + (i % 2 == 0 ? 0.1 : -0.1);
  }
  const auto survey = survey_known_positions(stations.scans, sick().model);
  ASSERT_TRUE(survey.has_value());
  expect_headings(stations, *survey, radians(0.5));
}

TEST(SurveyKnownPositions, LeavesNoGivenHeadingByMoreThanItMayErr) {
  Stations stations = stations_in_a_panel();
  for (std::size_t i = 0; i < stations.scans.size(); ++i) {
    const double error = i % 5 == 0 ? 0.5 : 0.05;  // more than it may in every fifth
    stations.scans[i].heading = wrap_angle(stations.headings[i] + error);
  }
  const KnownPositionsOptions options;
  const auto survey = survey_known_positions(stations.scans, sick().model, options);
  ASSERT_TRUE(survey.has_value());
  for (std::size_t i = 0; i < stations.scans.size(); ++i) {
    EXPECT_LE(std::abs(angle_between(survey->scans[i].map_from_vehicle.theta,
                                     *stations.scans[i].heading)),
              options.search.given_within_rad + 1e-9);
  }
}

/// Stations round a gallery that looks alike forwards and backwards, by a scanner that does not
/// look behind itself.
Stations stations_round_a_ring() {
  Stations out;
  const auto add_loop = [&](const std::vector<Vector2d>& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      out.walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
    }
  };
  add_loop({{0.0, 0.0},
            {20.0, 0.0},
            {20.0, 14.0},
            {8.0, 14.0},
            {8.0, 13.0},
            {7.0, 13.0},
            {7.0, 14.0},
            {0.0, 14.0}});
  add_loop({{3.0, 3.0},
            {3.0, 11.0},
            {17.0, 11.0},
            {17.0, 3.0},
            {12.0, 3.0},
            {12.0, 4.0},
            {9.0, 4.0},
            {9.0, 3.0}});
  const RayCaster caster(out.walls);
  Random random(5);
  const std::vector<Vector2d> way{{1.5, 1.5}, {18.5, 1.5}, {18.5, 12.5}, {1.5, 12.5}, {1.5, 1.5}};
  for (std::size_t leg = 0; leg + 1 < way.size(); ++leg) {
    const Vector2d along = way[leg + 1] - way[leg];
    const double heading = std::atan2(along.y(), along.x());
    for (double done = 0.2; done < along.norm(); done += 3.6) {
      const Vector2d at = way[leg] + done * along.normalized();
      const Pose2 pose{at.x(), at.y(), heading};
      out.scans.push_back({simulate_scan(caster, pose, sick(), random), at, std::nullopt});
      out.headings.push_back(heading);
    }
  }
  return out;
}

TEST(SurveyKnownPositions, TakesNoStationForReversedInAGalleryThatLooksAlikeBothWays) {
  const Stations stations = stations_round_a_ring();
  KnownPositionsOptions by_stations;  // by what other stations saw through
  by_stations.rounds = 0;
  KnownPositionsOptions by_walls;
  by_walls.search.against = 0.0;
  for (const KnownPositionsOptions& options : {by_stations, by_walls, KnownPositionsOptions{}}) {
    const auto survey = survey_known_positions(stations.scans, sick().model, options);
    ASSERT_TRUE(survey.has_value());
    expect_headings(stations, *survey, radians(1.0));
    EXPECT_GT(length_near_truth(stations, survey->walls, 0.1), 110.0);
  }
}

TEST(SurveyKnownPositions, IsToldForwardsFromBackwardsByTheHeadingsThatAreGiven) {
  Stations stations = stations_round_a_ring();
  KnownPositionsOptions options;  // nothing else tells them apart
  options.search.against = 0.0;
  options.rounds = 0;
  const auto count_reversed = [&] {
    const auto survey = survey_known_positions(stations.scans, sick().model, options);
    EXPECT_TRUE(survey.has_value());
    std::size_t count = 0;
    for (std::size_t i = 0; survey && i < stations.headings.size(); ++i) {
      const double theta = survey->scans[i].map_from_vehicle.theta;
      count += std::abs(angle_between(theta, stations.headings[i])) > radians(90.0) ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(count_reversed(), 0u);
  for (std::size_t i = 0; i < stations.scans.size(); ++i) {
    stations.scans[i].heading = stations.headings[i] + (i % 2 == 0 ? 0.1 : -0.1);
  }
  EXPECT_EQ(count_reversed(), 0u);
}

TEST(SurveyKnownPositions, RefusesStationsThatShareNoWalls) {
  Stations stations = stations_in_a_panel();
  stations.scans.resize(4);
  stations.scans[2].position.x() += 500.0;
  stations.scans[3].position.x() += 500.0;
  const auto survey = survey_known_positions(stations.scans, sick().model);
  ASSERT_FALSE(survey.has_value());
  EXPECT_NE(to_string(survey.error()).find("headings cannot be found"), std::string::npos);
}

TEST(SurveyKnownPositions, LeavesOutAStationThatNoOtherAgreesWith) {
  Stations stations = stations_in_a_panel();
  for (std::size_t i = 14; i < 16; ++i) stations.scans[i].position.y() += 500.0;
  const auto survey = survey_known_positions(stations.scans, sick().model);
  ASSERT_TRUE(survey.has_value());
  EXPECT_FALSE(survey->stations.back().placed);
  EXPECT_TRUE(survey->stations.front().placed);
  EXPECT_EQ(survey->levelled.size(), 14U);  // what a plan is compared with has none of it either
  EXPECT_EQ(survey->visits.size(), 14U);
  EXPECT_TRUE(std::is_sorted(survey->visits.begin(), survey->visits.end()));
  for (const PosedScan& scan : survey->levelled) EXPECT_LT(scan.map_from_vehicle.y, 250.0);
  EXPECT_GT(length_near_truth(stations, survey->walls, 0.15), 40.0);
}

TEST(SurveyKnownPositions, LeavesOutAStationWhosePositionIsWrong) {
  Stations stations = stations_in_a_panel();
  for (std::size_t i = 8; i < 10; ++i) stations.scans[i].position.y() += 10.0;  // within a pillar
  const auto survey = survey_known_positions(stations.scans, sick().model);
  ASSERT_TRUE(survey.has_value());
  for (std::size_t s = 0; s < survey->stations.size(); ++s) {
    EXPECT_EQ(survey->stations[s].placed, s != 4)
        << "agreement " << survey->stations[s].heading.agreement << ", contradiction "
        << survey->stations[s].heading.contradiction;
  }
  EXPECT_GT(length_near_truth(stations, survey->walls, 0.15), 40.0);
}

TEST(SurveyKnownPositions, RefusesOneStation) {
  Stations stations = stations_in_a_panel();
  stations.scans.resize(2);
  EXPECT_FALSE(survey_known_positions(stations.scans, sick().model).has_value());
  EXPECT_FALSE(survey_known_positions({}, sick().model).has_value());
}

TEST(PlaceScans, TakesThePoseOfTheSameStamp) {
  const std::vector<StampedPose> poses{{2.0, {3.0, 0.0, 0.5}}, {1.0, {1.0, 0.0, 0.1}}};
  const auto placed = place_scans(scans_at({1.0, 2.0}), poses, GivenHeadings::automatic);
  ASSERT_TRUE(placed.has_value());
  EXPECT_EQ((*placed)[0].position.x(), 1.0);
  EXPECT_EQ((*placed)[1].position.x(), 3.0);
  EXPECT_EQ((*placed)[1].heading, 0.5);
}

TEST(PlaceScans, GivesAStationsScansItsPose) {
  const std::vector<StampedPose> first{{0.0, {1.0, 0.0, 0.0}}, {3.0, {2.0, 0.0, 0.0}}};
  const auto after_first =
      place_scans(scans_at({0.0, 1.0, 2.0, 3.0, 4.0}), first, GivenHeadings::automatic);
  ASSERT_TRUE(after_first.has_value());
  const std::vector<double> expected{1.0, 1.0, 1.0, 2.0, 2.0};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ((*after_first)[i].position.x(), expected[i]);
    EXPECT_FALSE((*after_first)[i].heading.has_value());  // all alike: positions alone
    EXPECT_EQ((*after_first)[i].has_own_pose, i % 3 == 0);
  }
  const std::vector<StampedPose> last{{2.0, {1.0, 0.0, 0.0}}, {4.0, {2.0, 0.0, 0.0}}};
  const auto before_last =
      place_scans(scans_at({0.0, 1.0, 2.0, 3.0, 4.0}), last, GivenHeadings::none);
  ASSERT_TRUE(before_last.has_value());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ((*before_last)[i].position.x(), expected[i]);
  }
}

TEST(PlaceScans, NeedsPosesAndScans) {
  EXPECT_FALSE(place_scans(scans_at({1.0}), {}, GivenHeadings::none).has_value());
  EXPECT_FALSE(place_scans({}, std::vector<StampedPose>(1), GivenHeadings::none).has_value());
}

}  // namespace
}  // namespace adit
