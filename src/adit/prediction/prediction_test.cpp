#include "adit/prediction/prediction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace adit {
namespace {

double bearing_of(const Vector2d& v) { return std::atan2(v.y(), v.x()); }

/// A world drawn with characters, one metre each: '+' a vertex, '-' and '|' walls between two
/// vertices, '@' the observer, who is the origin.
std::vector<Segment> drawn(const std::vector<std::string>& rows) {
  const auto at = [&](std::size_t row, std::size_t column) {
    return column < rows[row].size() ? rows[row][column] : ' ';
  };
  Vector2d observer = Vector2d::Zero();
  std::size_t columns = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    columns = std::max(columns, rows[r].size());
    const std::size_t c = rows[r].find('@');
    if (c != std::string::npos) observer = Vector2d(c, -static_cast<double>(r));
  }
  const auto point = [&](std::size_t r, std::size_t c) -> Vector2d {
    return Vector2d(c, -static_cast<double>(r)) - observer;
  };
  std::vector<Segment> segments;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      if (at(r, c) != '+') continue;
      std::size_t end = c + 1;
      while (at(r, end) == '-') ++end;
      if (end > c + 1 && at(r, end) == '+') segments.push_back({point(r, c), point(r, end)});
      end = r + 1;
      while (end < rows.size() && at(end, c) == '|') ++end;
      if (end > r + 1 && end < rows.size() && at(end, c) == '+') {
        segments.push_back({point(r, c), point(end, c)});
      }
    }
  }
  return segments;
}

struct Seen {
  LineMap map;
  Vector2d observer = Vector2d::Zero();
  FeatureList features;

  const Corner* corner_at(double x, double y) const {
    for (const Corner& corner : features.corners) {
      if ((corner.position - Vector2d(x, y)).norm() < 1e-6) return &corner;
    }
    return nullptr;
  }
  int lines_on_wall_of(const Line& line) const {
    return static_cast<int>(
        std::count_if(features.lines.begin(), features.lines.end(),
                      [&](const Line& other) { return other.segment == line.segment; }));
  }
};

Seen predict(const std::vector<Segment>& segments, const Vector2d& observer,
             const PredictionOptions& options = {}, double max_range = 50.0) {
  LineMapOptions cleaning;
  cleaning.snap_m = 1e-6;
  cleaning.merge_offset_m = 1e-6;
  Seen seen;
  seen.map = LineMap::build(segments, cleaning);
  seen.observer = observer;
  Visibility visibility;
  visibility.sweep(seen.map, observer, max_range);
  predict_features(seen.map, visibility, observer, options, seen.features);
  return seen;
}

Seen predict(const std::vector<std::string>& rows) {
  return predict(drawn(rows), Vector2d::Zero());
}

/// What must hold for any prediction.
void expect_sound(const Seen& seen) {
  const FeatureList& f = seen.features;
  for (const Line& line : f.lines) {
    const Vector2d outward = unit_vector(line.orientation);
    EXPECT_NEAR(outward.dot(line.begin), line.distance, 1e-9);
    EXPECT_NEAR(outward.dot(line.end), line.distance, 1e-9);
    EXPECT_GE(line.distance, 0.0);
    EXPECT_GT(cross(line.begin, line.end), 0.0);
    EXPECT_EQ(line.points, 0);
    const Wall& wall = seen.map.walls()[static_cast<std::size_t>(line.segment)];
    const Vector2d middle = 0.5 * (line.begin + line.end) + seen.observer;
    EXPECT_LE(distance(wall.segment, middle), 0.5 * line.length() + 1e-9);
  }
  for (const Corner& corner : f.corners) {
    const Vector2d vertex = seen.map.vertices()[static_cast<std::size_t>(corner.vertex)];
    EXPECT_LE((corner.position + seen.observer - vertex).norm(), 1e-9);
    EXPECT_TRUE(corner.arms[0] >= 0 || corner.arms[1] >= 0);
    EXPECT_EQ(corner.occluding, corner.arms[0] < 0 || corner.arms[1] < 0);
    EXPECT_EQ(corner.concave_angle.has_value(), corner.bisector.has_value());
    if (corner.arms[0] >= 0) {
      const Line& before = f.lines[static_cast<std::size_t>(corner.arms[0])];
      EXPECT_LE((before.end - corner.position).norm(), 1e-9);
    }
    if (corner.arms[1] >= 0) {
      const Line& after = f.lines[static_cast<std::size_t>(corner.arms[1])];
      EXPECT_LE((after.begin - corner.position).norm(), 1e-9);
    }
    if (corner.arms[0] < 0 || corner.arms[1] < 0) continue;
    const Line& before = f.lines[static_cast<std::size_t>(corner.arms[0])];
    const Line& after = f.lines[static_cast<std::size_t>(corner.arms[1])];
    const Vector2d a = (before.begin - corner.position).normalized();
    const Vector2d b = (after.end - corner.position).normalized();
    EXPECT_NEAR(*corner.concave_angle, std::acos(std::clamp(a.dot(b), -1.0, 1.0)), 1e-6);
    EXPECT_NEAR(angle_between(*corner.bisector, bearing_of(a + b)), 0.0, 1e-6);
  }
  FeatureList again = f;
  sort_counter_clockwise(again);
  ASSERT_EQ(f.order.size(), again.order.size());
  for (std::size_t i = 0; i < f.order.size(); ++i) {
    EXPECT_NEAR(f.order[i].azimuth, again.order[i].azimuth, 1e-9);
    EXPECT_GT(f.order[i].azimuth, -kPi);
    EXPECT_LE(f.order[i].azimuth, kPi);
    if (i > 0) {
      EXPECT_LE(f.order[i - 1].azimuth, f.order[i].azimuth);
    }
  }
}

TEST(Prediction, EmptyMapHasNoFeatures) {
  const Seen seen = predict(std::vector<Segment>{}, Vector2d::Zero());
  EXPECT_EQ(seen.features.size(), 0u);
  EXPECT_TRUE(seen.features.order.empty());
}

TEST(Prediction, RoomHasFourCornersAndFourLines) {
  const Seen seen = predict({"+-----------+",  //
                             "|           |",  //
                             "|  @        |",  //
                             "|           |",  //
                             "|           |",  //
                             "+-----------+"});
  expect_sound(seen);
  ASSERT_EQ(seen.features.corners.size(), 4u);
  ASSERT_EQ(seen.features.lines.size(), 4u);
  const Corner* upper_right = seen.corner_at(9, 2);
  ASSERT_NE(upper_right, nullptr);
  EXPECT_FALSE(upper_right->occluding);
  EXPECT_NEAR(*upper_right->concave_angle, radians(90), 1e-12);
  EXPECT_NEAR(*upper_right->bisector, radians(-135), 1e-12);
  const Line& right = seen.features.lines[static_cast<std::size_t>(upper_right->arms[0])];
  EXPECT_NEAR(right.orientation, 0.0, 1e-12);
  EXPECT_NEAR(right.distance, 9.0, 1e-12);
  EXPECT_NEAR(right.length(), 5.0, 1e-12);
  const Line& top = seen.features.lines[static_cast<std::size_t>(upper_right->arms[1])];
  EXPECT_NEAR(top.orientation, radians(90), 1e-12);
  EXPECT_NEAR(top.distance, 2.0, 1e-12);
  // Corners and lines take turns around the room.
  for (std::size_t i = 1; i < seen.features.order.size(); ++i) {
    EXPECT_NE(seen.features.order[i].kind, seen.features.order[i - 1].kind);
  }
}

TEST(Prediction, PillarOccludesAndItsShadowMakesNoCorner) {
  const Seen seen = predict({"+-----------------+",  //
                             "|                 |",  //
                             "|      +---+      |",  //
                             "|      |   |      |",  //
                             "|      +---+      |",  //
                             "|                 |",  //
                             "|        @        |",  //
                             "+-----------------+"});
  expect_sound(seen);
  // Four corners of the room and the two near ones of the pillar.
  EXPECT_EQ(seen.features.corners.size(), 6u);
  const Corner* right = seen.corner_at(2, 2);
  ASSERT_NE(right, nullptr);
  EXPECT_TRUE(right->occluding);
  EXPECT_EQ(right->arms[0], -1);
  ASSERT_GE(right->arms[1], 0);
  EXPECT_NEAR(*right->concave_angle, radians(90), 1e-12);
  EXPECT_NEAR(*right->bisector, radians(135), 1e-12);  // into the pillar
  const Corner* left = seen.corner_at(-2, 2);
  ASSERT_NE(left, nullptr);
  EXPECT_EQ(left->arms[0], right->arms[1]);
  EXPECT_EQ(left->arms[1], -1);
  // Its shadow cuts the far wall: two pieces of one wall.
  EXPECT_EQ(seen.features.lines.size(), 6u);
  const auto far =
      std::find_if(seen.features.lines.begin(), seen.features.lines.end(),
                   [](const Line& line) { return std::abs(line.distance - 6) < 1e-9; });
  ASSERT_NE(far, seen.features.lines.end());
  EXPECT_EQ(seen.lines_on_wall_of(*far), 2);
}

TEST(Prediction, PillarSeenAcrossItsCorner) {
  const Seen seen = predict({"   +----+",  //
                             "   |    |",  //
                             "   |    |",  //
                             "   +----+",  //
                             "         ",  //
                             "@        "});
  expect_sound(seen);
  ASSERT_EQ(seen.features.corners.size(), 3u);
  const Corner* near = seen.corner_at(3, 2);
  ASSERT_NE(near, nullptr);
  EXPECT_FALSE(near->occluding);
  EXPECT_NEAR(*near->concave_angle, radians(90), 1e-12);
  EXPECT_NEAR(*near->bisector, radians(45), 1e-12);
  ASSERT_NE(seen.corner_at(8, 2), nullptr);
  EXPECT_TRUE(seen.corner_at(8, 2)->occluding);
  EXPECT_TRUE(seen.corner_at(3, 5)->occluding);
}

TEST(Prediction, FreeEndHasNoConcaveAngle) {
  const Seen seen = predict({"+-------+",  //
                             "         ",  //
                             "    @    "});
  expect_sound(seen);
  ASSERT_EQ(seen.features.corners.size(), 2u);
  for (const Corner& corner : seen.features.corners) {
    EXPECT_TRUE(corner.occluding);
    EXPECT_FALSE(corner.concave_angle);
  }
}

TEST(Prediction, WallBehindAWallMakesNoCorner) {
  const Seen seen = predict({"      +      ",  //
                             "      |      ",  //
                             "+-----+-----+",  //
                             "|           |",  //
                             "|     @     |",  //
                             "+-----------+"});
  expect_sound(seen);
  EXPECT_EQ(seen.features.corners.size(), 4u);
  EXPECT_EQ(seen.features.lines.size(), 4u);
}

TEST(Prediction, WallInFrontOfAWallMakesACornerOnItsVisibleSide) {
  const Seen seen = predict({"+---------+---------+",  //
                             "|         |         |",  //
                             "|         |         |",  //
                             "|         +         |",  //
                             "|                   |",  //
                             "|    @              |",  //
                             "+-------------------+"});
  expect_sound(seen);
  const Corner* foot = seen.corner_at(5, 5);
  ASSERT_NE(foot, nullptr);
  EXPECT_FALSE(foot->occluding);
  EXPECT_NEAR(*foot->concave_angle, radians(90), 1e-12);
  EXPECT_NEAR(*foot->bisector, radians(-135), 1e-12);
  const Corner* tip = seen.corner_at(5, 2);
  ASSERT_NE(tip, nullptr);
  EXPECT_TRUE(tip->occluding);
  EXPECT_FALSE(tip->concave_angle);
}

TEST(Prediction, ThreeWallsAtAVertexUseTheVisibleArms) {
  // The far arm of the crossing is hidden: two walls are known beside the visible one.
  const Seen seen = predict({"         +      ",  //
                             "         |      ",  //
                             "         |      ",  //
                             "   +-----+-----+",  //
                             "         |      ",  //
                             "         |      ",  //
                             " @       +      "});
  expect_sound(seen);
  const Corner* crossing = seen.corner_at(8, 3);
  ASSERT_NE(crossing, nullptr);
  EXPECT_FALSE(crossing->occluding);
  EXPECT_NEAR(*crossing->concave_angle, radians(90), 1e-12);
}

TEST(Prediction, SlightBendIsNoCornerButTwoLines) {
  const double rise = std::tan(radians(2.5)) * 6.0;
  const Seen seen =
      predict({{Vector2d(-6, 3), Vector2d(0, 3)}, {Vector2d(0, 3), Vector2d(6, 3 + rise)}},
              Vector2d::Zero());
  expect_sound(seen);
  EXPECT_EQ(seen.corner_at(0, 3), nullptr);
  EXPECT_EQ(seen.features.lines.size(), 2u);
}

TEST(Prediction, OneStraightWallDrawnInPiecesIsOneLine) {
  // Pieces of 0.2 m that a wall behind ends at: none is long enough, together they are.
  std::vector<Segment> segments;
  for (int i = 0; i < 10; ++i) {
    segments.push_back({Vector2d(0.2 * i, 3), Vector2d(0.2 * (i + 1), 3)});
    segments.push_back({Vector2d(0.2 * i, 3), Vector2d(0.2 * i, 5)});
  }
  const Seen seen = predict(segments, Vector2d(1.0, 0.0));
  expect_sound(seen);
  ASSERT_EQ(seen.features.lines.size(), 1u);
  EXPECT_NEAR(seen.features.lines[0].length(), 2.0, 1e-12);
  EXPECT_EQ(seen.features.corners.size(), 2u);
}

TEST(Prediction, JogTooSmallToResolveLeavesOnlyItsLines) {
  const Seen seen = predict({{Vector2d(5, -5), Vector2d(5, 0.1)},
                             {Vector2d(5, 0.1), Vector2d(5.2, 0.1)},
                             {Vector2d(5.2, 0.1), Vector2d(5.2, 5)}},
                            Vector2d(0, 3));
  expect_sound(seen);
  EXPECT_EQ(seen.features.lines.size(), 2u);
  EXPECT_EQ(seen.corner_at(5, -2.9), nullptr);
  EXPECT_EQ(seen.corner_at(5.2, -2.9), nullptr);
}

TEST(Prediction, EndOfAThickWallOccludes) {
  // The face of the end is 0.2 m wide: a scanner sees the long side end in a drop.
  const Seen seen = predict({{Vector2d(3, -5), Vector2d(3, 0)},
                             {Vector2d(3, 0), Vector2d(3.2, 0)},
                             {Vector2d(3.2, 0), Vector2d(3.2, -5)},
                             {Vector2d(20, -20), Vector2d(20, 20)}},
                            Vector2d(0, 2));
  expect_sound(seen);
  const Corner* end = seen.corner_at(3, -2);
  ASSERT_NE(end, nullptr);
  EXPECT_TRUE(end->occluding);
  EXPECT_GE(end->arms[0], 0);
  EXPECT_EQ(end->arms[1], -1);
  EXPECT_NEAR(*end->concave_angle, radians(90), 1e-12);
  EXPECT_EQ(seen.corner_at(3.2, -2), nullptr);
}

TEST(Prediction, PiecesBelowTheOptionsMakeNoLine) {
  const std::vector<Segment> far_and_small = {{Vector2d(40, -0.3), Vector2d(40, 0.3)},
                                              {Vector2d(-2, -0.1), Vector2d(-2, 0.1)}};
  EXPECT_EQ(predict(far_and_small, Vector2d::Zero()).features.size(), 0u);
  PredictionOptions fine;
  fine.min_line_m = 0.0;
  fine.min_line_rad = 0.0;
  EXPECT_EQ(predict(far_and_small, Vector2d::Zero(), fine).features.size(), 6u);
}

TEST(Prediction, RangeLimitMakesNoCorner) {
  const Seen seen = predict({{Vector2d(3, -100), Vector2d(3, 100)}}, Vector2d::Zero(), {}, 5.0);
  EXPECT_TRUE(seen.features.corners.empty());
  ASSERT_EQ(seen.features.lines.size(), 1u);
  EXPECT_NEAR(seen.features.lines[0].length(), 8.0, 1e-9);
}

TEST(Prediction, NothingHappensAtTheSeam) {
  // A corner, a straight continuation and a free end, each exactly at bearing pi.
  const Seen corner = predict(
      {{Vector2d(-4, 0), Vector2d(-2, 3)}, {Vector2d(-4, 0), Vector2d(-2, -3)}}, Vector2d::Zero());
  expect_sound(corner);
  ASSERT_NE(corner.corner_at(-4, 0), nullptr);
  EXPECT_FALSE(corner.corner_at(-4, 0)->occluding);
  EXPECT_EQ(corner.features.corners.size(), 3u);
  const Seen straight = predict({{Vector2d(-4, 0), Vector2d(-4, 3)},
                                 {Vector2d(-4, 0), Vector2d(-4, -3)},
                                 {Vector2d(-4, 0), Vector2d(-6, 0.5)}},
                                Vector2d::Zero());
  expect_sound(straight);
  EXPECT_EQ(straight.features.lines.size(), 1u);
  EXPECT_EQ(straight.features.corners.size(), 2u);
  const Seen end = predict({{Vector2d(-4, 0), Vector2d(-4, 3)}}, Vector2d::Zero());
  expect_sound(end);
  EXPECT_EQ(end.features.corners.size(), 2u);
}

TEST(Prediction, FarEndInLineWithANearEndIsNoCorner) {
  // Seen from the origin the far wall ends exactly where the near one begins.
  const Seen seen = predict({{Vector2d(2, 1), Vector2d(2, 3)}, {Vector2d(6, -3), Vector2d(6, 3)}},
                            Vector2d::Zero());
  expect_sound(seen);
  EXPECT_NE(seen.corner_at(2, 1), nullptr);
  EXPECT_EQ(seen.corner_at(6, 3), nullptr);
  EXPECT_NE(seen.corner_at(6, -3), nullptr);
}

}  // namespace
}  // namespace adit
