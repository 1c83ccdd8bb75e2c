#include <gtest/gtest.h>

#include <cmath>

#include "adit/survey/wall_polyline.hpp"

namespace adit {
namespace {

std::vector<Vector2d> row(const Vector2d& from, const Vector2d& to, double spacing) {
  std::vector<Vector2d> points;
  const int n = static_cast<int>((to - from).norm() / spacing);
  for (int i = 0; i < n; ++i) points.emplace_back(from + (to - from) * (i + 0.5) / n);
  return points;
}

std::vector<Vector2d> corner_of(double size) {
  std::vector<Vector2d> points = row({0.0, 0.0}, {size, 0.0}, 0.1);
  const auto up = row({size, 0.0}, {size, size}, 0.1);
  points.insert(points.end(), up.begin(), up.end());
  return points;
}

TEST(SplitIntoLines, KeepsAStraightWallWhole) {
  const auto points = row({512000.0, 4500000.0}, {512009.0, 4500012.0}, 0.1);
  EXPECT_EQ(split_into_lines(points, 0.1, 0.04), std::vector<std::size_t>{0});
}

TEST(SplitIntoLines, BreaksAtACornerAndNowhereElse) {
  const auto points = corner_of(3.0);
  EXPECT_EQ(split_into_lines(points, 0.1, 0.04), (std::vector<std::size_t>{0, 30}));
}

TEST(SplitIntoLines, StaysWithinTheToleranceOnACurve) {
  std::vector<Vector2d> points;
  for (int i = 0; i < 150; ++i) points.emplace_back(5.0 * unit_vector(0.02 * i));
  std::size_t pieces_before = 1000;
  for (const double tolerance : {0.01, 0.04, 0.16}) {
    const auto begins = split_into_lines(points, 0.1, tolerance);
    for (std::size_t k = 0; k < begins.size(); ++k) {
      const std::size_t end = k + 1 < begins.size() ? begins[k + 1] : points.size();
      Moments moments;
      for (std::size_t i = begins[k]; i < end; ++i) moments.add(points[i].x(), points[i].y());
      const LineFit line = fit_line(moments);
      for (std::size_t i = begins[k]; i < end; ++i) {
        EXPECT_LE(std::abs(cross(line.direction, points[i] - line.centroid)), tolerance + 1e-9);
      }
    }
    EXPECT_LT(begins.size(), pieces_before);
    pieces_before = begins.size();
  }
}

TEST(FitVertices, MeetAtTheCorner) {
  const auto points = corner_of(3.0);
  const std::vector<std::size_t> begins{0, 30};
  const auto vertices = fit_vertices(points, begins, false, 0.3);
  ASSERT_EQ(vertices.size(), 3u);
  EXPECT_NEAR((vertices[1] - Vector2d(3.0, 0.0)).norm(), 0.0, 1e-3);
}

TEST(FitVertices, CloseARing) {
  std::vector<Vector2d> points = corner_of(3.0);
  const auto back = row({3.0, 3.0}, {0.0, 3.0}, 0.1);
  const auto down = row({0.0, 3.0}, {0.0, 0.0}, 0.1);
  points.insert(points.end(), back.begin(), back.end());
  points.insert(points.end(), down.begin(), down.end());
  const std::vector<std::size_t> begins{0, 30, 60, 90};
  const auto vertices = fit_vertices(points, begins, true, 0.3);
  ASSERT_EQ(vertices.size(), 5u);
  EXPECT_EQ(vertices.front(), vertices.back());
  EXPECT_NEAR(vertices.front().norm(), 0.0, 1e-3);
  EXPECT_NEAR((vertices[2] - Vector2d(3.0, 3.0)).norm(), 0.0, 1e-3);
}

TEST(FitVertices, KeepsTheVertexBetweenNearlyParallelPiecesAtTheirBreak) {
  // A rib that is a hair wavy, in two pieces: no point tells where along it they meet.
  std::vector<Vector2d> points;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.1 * i;
    points.emplace_back(x, (i < 30 ? 0.004 * x : 0.024 - 0.004 * x) + 0.01 * std::sin(7.0 * x));
  }
  const std::vector<std::size_t> begins{0, 30};
  const auto vertices = fit_vertices(points, begins, false, 0.3);
  ASSERT_EQ(vertices.size(), 3u);
  EXPECT_NEAR(vertices[1].x(), 2.95, 0.1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Segment piece{vertices[i < 30 ? 0 : 1], vertices[i < 30 ? 1 : 2]};
    EXPECT_LT(distance(piece, points[i]), 0.03);
  }
}

}  // namespace
}  // namespace adit
