#include "adit/survey/known_places.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

/// A way of 60 m with turns, and constraints between its poses that are off: it bends to the left.
struct BentDrive {
  std::vector<Pose2> truth;
  std::vector<Pose2> poses;
  std::vector<PoseConstraint> constraints;

  BentDrive() {
    constexpr std::size_t kPoses = 120;
    Pose2 at{10.0, -5.0, 0.7};
    Pose2 drifting;
    for (std::size_t i = 0; i < kPoses; ++i) {
      truth.push_back(at);
      poses.push_back(drifting);
      const Pose2 move{0.5, 0.0, i % 20 == 19 ? 0.8 : 0.0};
      const Pose2 seen{0.5, 0.0, move.theta + 0.004};
      at = at * move;
      drifting = drifting * seen;
      if (i + 1 < kPoses) {
        constraints.push_back({i, i + 1, seen, Vector3d(1e4, 1e4, 1e5).asDiagonal(), 0.0});
      }
    }
  }

  std::vector<KnownPlace> known(std::size_t begin, std::size_t end) const {
    std::vector<KnownPlace> places;
    for (std::size_t i = begin; i < end; ++i) {
      places.push_back({i, truth[i], Vector3d(1e-3, 1e-3, 1e-4).asDiagonal()});
    }
    return places;
  }

  double worst_error() const {
    double worst = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      worst = std::max(worst, (poses[i].translation() - truth[i].translation()).norm());
    }
    return worst;
  }
};

TEST(KnownPlaces, TakeTheDriftOutOfADrive) {
  BentDrive drive;
  solve_with_known_places(drive.poses, drive.constraints, drive.known(0, 120), {}, 50);
  EXPECT_LT(drive.worst_error(), 0.1);
}

TEST(KnownPlaces, CarryWhatIsNotKnownAlong) {
  BentDrive drive;
  auto places = drive.known(0, 30);
  for (const KnownPlace& place : drive.known(90, 120)) places.push_back(place);
  solve_with_known_places(drive.poses, drive.constraints, places, {}, 50);
  EXPECT_LT(drive.worst_error(), 0.4);
}

TEST(KnownPlaces, MoveAWholeDriveByOneAlone) {
  BentDrive drive;
  const Pose2 seen = inverse(drive.poses[0]) * drive.poses[50];
  solve_with_known_places(drive.poses, drive.constraints, drive.known(0, 1), {}, 50);
  EXPECT_LT(difference(drive.truth[0], drive.poses[0]).norm(), 1e-3);
  EXPECT_LT(difference(seen, inverse(drive.poses[0]) * drive.poses[50]).norm(), 1e-3);
}

TEST(KnownPlaces, AreNotAllBelieved) {
  BentDrive drive;
  auto places = drive.known(0, 120);
  for (std::size_t i = 50; i < 60; ++i) places[i].map_from_vehicle.x += 6.0;  // another drift
  solve_with_known_places(drive.poses, drive.constraints, places, {}, 50);
  EXPECT_LT(drive.worst_error(), 0.2);
}

}  // namespace
}  // namespace adit
