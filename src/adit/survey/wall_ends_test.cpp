#include "adit/survey/wall_ends.hpp"

#include <gtest/gtest.h>

#include "adit/survey/wall_polyline.hpp"

namespace adit {
namespace {

SurveyedWallLine line_of(const std::vector<Vector2d>& vertices) {
  SurveyedWallLine line;
  line.vertices = vertices;
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    SurveyedWall piece;
    piece.segment = {vertices[i - 1], vertices[i]};
    piece.covariance = Vector2d(1e-4, 1e-5).asDiagonal();
    line.pieces.push_back(piece);
  }
  return line;
}

/// A wall from x = 0 to 4 and one that comes down on it at x = 2 to this height.
std::vector<SurveyedWallLine> tee(double height) {
  return {line_of({{0.0, 0.0}, {4.0, 0.0}}), line_of({{2.0, 3.0}, {2.0, height}})};
}

double end_after_joining(double height) {
  auto lines = tee(height);
  const WallOptions options;
  BeamEvidence evidence(ScannerModel{}, options);
  join_ends(lines, evidence, options);
  EXPECT_EQ(lines[1].vertices.back(), lines[1].pieces.back().segment.b);
  EXPECT_EQ(lines[0].vertices.front(), Vector2d(0.0, 0.0));
  EXPECT_EQ(lines[0].vertices.back(), Vector2d(4.0, 0.0));
  EXPECT_EQ(lines[1].vertices.front(), Vector2d(2.0, 3.0));
  return lines[1].vertices.back().y();
}

TEST(JoinEnds, StopsAnEndThatRunsPastAWall) { EXPECT_NEAR(end_after_joining(-0.2), 0.0, 1e-9); }

TEST(JoinEnds, BringsAnEndToTheWallBefore) { EXPECT_NEAR(end_after_joining(0.2), 0.0, 1e-9); }

TEST(JoinEnds, TellsAnewHowWellAMovedEndIsKnown) {
  auto lines = tee(0.2);
  for (SurveyedWallLine& line : lines) set_vertex_covariances(line);
  const Matrix2d before = lines[1].covariances.back();
  const WallOptions options;
  BeamEvidence evidence(ScannerModel{}, options);
  join_ends(lines, evidence, options);
  ASSERT_EQ(lines[1].covariances.size(), 2U);
  EXPECT_GT(lines[1].covariances.back()(0, 0), before(0, 0));  // farther from the middle
}

TEST(JoinEnds, LeavesEndsThatAreFarFromWalls) {
  EXPECT_EQ(end_after_joining(0.5), 0.5);
  EXPECT_EQ(end_after_joining(-0.5), -0.5);
}

TEST(JoinEnds, LeavesAGapThatBeamsWentThrough) {
  auto lines = tee(0.25);
  const WallOptions options;
  BeamEvidence evidence(ScannerModel{}, options);
  // Something behind the gap, met by beams through it.
  std::vector<WallHit> hits;
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 10; ++k) {
      const Vector2d p(1.5 + 0.05 * i, 0.02 + 0.025 * k);
      hits.push_back({p, Vector2d::UnitX(), 1e-4, 0.0, 1.0});
    }
  }
  evidence.add(hits, 0);
  evidence.finish_adding();
  for (int k = 0; k < 20; ++k) {
    PosedScan posed;
    posed.map_from_vehicle = {0.5, 0.01 + 0.0125 * k, 0.0};
    posed.scan.ranges = {5.0};
    posed.scan.bearing_step = 0.01;
    posed.scan.max_range = 80.0;
    for (int again = 0; again < 4; ++again) evidence.look_through(posed, 0);
  }
  evidence.finish_looking();
  join_ends(lines, evidence, options);
  EXPECT_EQ(lines[1].vertices.back().y(), 0.25);
}

}  // namespace
}  // namespace adit
