#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "adit/simulation/random.hpp"
#include "adit/survey/wall_polyline.hpp"

namespace adit {
namespace {

WallNode node_at(const Vector2d& point, const Vector2d& normal) {
  WallNode node;
  node.point = point;
  node.normal = normal;
  node.visit_information = 1e4;
  node.hits = 50.0;
  node.scans = 10;
  node.visits = 3;
  node.sure = true;
  return node;
}

/// A rib that bends, with bumps of about the tolerance.
std::vector<WallNode> bumpy_rib(double spacing, std::uint64_t seed) {
  Random random(seed);
  std::vector<WallNode> nodes;
  double bump = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double x = spacing * i;
    bump = 0.9 * bump + 0.02 * random.normal();
    nodes.push_back(node_at({x, 0.8 * std::sin(0.5 * x) + bump}, {0.0, 1.0}));
  }
  return nodes;
}

double farthest_from(const SurveyedWallLine& line, const std::vector<WallNode>& nodes) {
  double farthest = 0.0;
  for (const WallNode& node : nodes) {
    double least = std::numeric_limits<double>::max();
    for (const SurveyedWall& piece : line.pieces) {
      least = std::min(least, distance(piece.segment, node.point));
    }
    farthest = std::max(farthest, least);
  }
  return farthest;
}

TEST(MakeWallLine, FollowsTheWallToWithinTheTolerance) {
  const WallOptions options;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    const std::vector<WallNode> nodes = bumpy_rib(node_spacing(options), seed);
    WallChain chain;
    chain.nodes.resize(nodes.size());
    std::iota(chain.nodes.begin(), chain.nodes.end(), 0);
    const auto line = make_wall_line(nodes, chain, options);
    ASSERT_TRUE(line.has_value());
    // Pieces of less than four nodes, and of few at the ends, stay whole: a hair more.
    EXPECT_LE(farthest_from(*line, nodes), 1.2 * options.tolerance_m) << "seed " << seed;
    EXPECT_LT(line->pieces.size(), nodes.size() / 4);
    ASSERT_EQ(line->covariances.size(), line->vertices.size());
    for (std::size_t i = 0; i < line->pieces.size(); ++i) {
      // No end is surer across its wall than the wall is in its middle.
      const Segment& s = line->pieces[i].segment;
      const Vector2d normal = perpendicular(s.b - s.a).normalized();
      const double across = normal.dot(line->covariances[i] * normal);
      EXPECT_GT(across, 0.2 * line->pieces[i].covariance(0, 0));
      EXPECT_LE(across, 0.1 * 0.1 + 1e-12);
    }
  }
}

}  // namespace
}  // namespace adit
