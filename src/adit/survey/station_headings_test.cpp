#include "adit/survey/station_headings.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

/// The walls of a room of no symmetry, as seen from inside: points in the map.
std::vector<StationPoint> surfaces() {
  std::vector<StationPoint> points;
  const std::vector<Vector2d> corners{{0.0, 0.0}, {9.0, 0.0}, {9.0, 4.0},
                                      {6.0, 4.0}, {6.0, 7.0}, {0.0, 7.0}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d a = corners[i];
    const Vector2d along = corners[(i + 1) % corners.size()] - a;
    const int count = static_cast<int>(along.norm() / 0.1);
    for (int k = 0; k < count; ++k) {
      points.push_back({a + along * k / count, perpendicular(along).normalized()});
    }
  }
  return points;
}

StationView view_from(const Pose2& pose) {
  StationView view;
  view.position = pose.translation();
  const RigidTransform into(inverse(pose));
  for (const StationPoint& p : surfaces()) {
    view.points.push_back({into.point(p.point), into.direction(p.normal)});
  }
  return view;
}

TEST(FindHeadings, FindsAllHeadingsInTheFrameOfThePositions) {
  const std::vector<Pose2> truth{
      {1.5, 1.5, 2.8}, {3.0, 2.0, -1.1}, {5.0, 2.0, 0.4}, {7.5, 2.0, 3.1}, {2.0, 5.0, -2.2}};
  std::vector<StationView> views;
  for (const Pose2& pose : truth) views.push_back(view_from(pose));
  const auto found = find_headings(views);
  ASSERT_EQ(found.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(std::abs(angle_between(truth[i].theta, found[i].heading_rad)), radians(0.3));
    EXPECT_GT(found[i].agreement, 0.7);
    EXPECT_LT(found[i].sigma_rad, radians(1.0));
  }
}

TEST(FindHeadings, SaysNothingOfOneStation) {
  EXPECT_TRUE(find_headings({}).empty());
  const std::vector<StationView> one{view_from({1.0, 1.0, 0.5})};
  const auto found = find_headings(one);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].sigma_rad, kPi);
}

TEST(FindTurn, TurnsAScanOntoAnotherFromTheSamePlace) {
  const StationView first = view_from({2.0, 2.0, 0.0});
  const StationView second = view_from({2.0, 2.0, 0.7});
  StationField field(first.points, 0.2);
  // A step of a degree tells where to look with finer ones.
  const double roughly = find_turn(second.points, field, -kPi, kPi, radians(1.0));
  EXPECT_NEAR(roughly, 0.7, radians(1.0));
  EXPECT_NEAR(
      find_turn(second.points, field, roughly - radians(1.0), roughly + radians(1.0), radians(0.1)),
      0.7, radians(0.2));
}

TEST(StationField, AgreesWithLikeSurfacesOnly) {
  const std::vector<StationPoint> wall{{{1.0, 1.0}, {0.0, 1.0}}};
  StationField field(wall, 0.2);
  EXPECT_GT(field.agreement({1.0, 1.0}, {0.0, 1.0}), 0.8);
  EXPECT_EQ(field.agreement({1.0, 1.0}, {0.0, -1.0}), 0.0);
  EXPECT_LT(field.agreement({1.0, 1.4}, {0.0, 1.0}), 0.25);
  EXPECT_EQ(field.agreement({9.0, 9.0}, {0.0, 1.0}), 0.0);
}

}  // namespace
}  // namespace adit
