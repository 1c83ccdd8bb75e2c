#include "adit/scan_motion/surface_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adit/scan_motion/evidence_field.hpp"
#include "adit/simulation/random.hpp"

namespace adit {
namespace {

std::vector<SurfacePoint> scattered(std::size_t count, Random& random) {
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d place(2.0 * random.normal(), 2.0 * random.normal());
    points.push_back({place.cast<float>(), unit_vector(kTwoPi * random.normal()).cast<float>()});
  }
  return points;
}

TEST(SurfaceMap, FindsTheNearestThatFacesTheSameWay) {
  Random random(11);
  SurfaceMap map(1e-4, 0.3);  // nothing is merged
  map.add(scattered(400, random), RigidTransform(Pose2{}));
  map.index();
  int found = 0;
  for (const SurfacePoint& query : scattered(300, random)) {
    const SurfacePoint* best = nullptr;
    for (const SurfacePoint& p : map.points()) {
      const float apart = (p.point - query.point).norm();
      if (apart > 0.25F || p.normal.dot(query.normal) < 0.7F) continue;
      if (best == nullptr || apart < (best->point - query.point).norm()) best = &p;
    }
    EXPECT_EQ(map.nearest(query.point, query.normal, 0.25F), best);
    found += best != nullptr;
  }
  EXPECT_GT(found, 20);
}

TEST(SurfaceMap, MergesWhatLiesInOneCellAndFacesOneWay) {
  SurfaceMap map(0.1, 0.3);
  const Eigen::Vector2f up(0.0F, 1.0F);
  const std::vector<SurfacePoint> points = {
      {{0.02F, 0.02F}, up}, {{0.06F, 0.04F}, up}, {{0.04F, 0.03F}, -up}, {{0.05F, 0.05F}, {0, 0}}};
  map.add(points, RigidTransform(Pose2{}));
  map.index();
  ASSERT_EQ(map.points().size(), 2U);  // one without a normal is no wall to lie on
  const SurfacePoint* merged = map.nearest({0.0F, 0.0F}, up, 0.2F);
  ASSERT_NE(merged, nullptr);
  EXPECT_NEAR(merged->point.x(), 0.04F, 1e-6F);
  EXPECT_NEAR(merged->point.y(), 0.03F, 1e-6F);
}

TEST(SurfaceMap, IsEmptyBeforeAndAfter) {
  SurfaceMap map;
  EXPECT_EQ(map.nearest({0, 0}, {1, 0}, 1.0F), nullptr);
  const std::vector<SurfacePoint> one = {{{0, 0}, {1, 0}}};
  map.add(one, RigidTransform(Pose2{3.0, 0.0, 0.0}));
  map.index();
  EXPECT_NE(map.nearest({3, 0}, {1, 0}, 0.1F), nullptr);
  map.clear();
  EXPECT_EQ(map.nearest({3, 0}, {1, 0}, 0.1F), nullptr);
}

/// A wall from (2, -1) to (2, 1), seen from the origin.
ScanShape wall_ahead() {
  ScanShape shape;
  for (float y = -1.0F; y <= 1.0F; y += 0.05F) shape.points.push_back({{2.0F, y}, {-1.0F, 0.0F}});
  return shape;
}

TEST(EvidenceField, TellsWallsFromWhatIsFreeAndWhatIsUnseen) {
  const ScanShape wall = wall_ahead();
  const PlacedShape placed{&wall, {}};
  EvidenceField field;
  const FieldOptions options;
  field.build({&placed, 1}, true, options);
  const auto at = [&](double x, double y) { return field.at(0, field.column(x), field.row(y)); };
  const int unseen = static_cast<int>(std::lround(255.0 * options.unseen));
  EXPECT_EQ(at(2.0, 0.3), 255);
  EXPECT_EQ(at(1.0, 0.0), 0);
  EXPECT_EQ(at(3.0, 0.0), unseen);
  EXPECT_EQ(at(500.0, 0.0), unseen);
  field.build({&placed, 1}, false, options);
  EXPECT_EQ(at(2.0, 0.3), 255);
  EXPECT_EQ(at(3.0, 0.0), 0);
}

TEST(EvidenceField, BoundsAllCellsOfABlock) {
  const ScanShape wall = wall_ahead();
  const PlacedShape placed{&wall, {0.0, 0.0, 0.4}};
  EvidenceField field;
  field.build({&placed, 1}, true, {});
  for (int level = 1; level < EvidenceField::kLevels; ++level) {
    const int side = 1 << level;
    for (int row = -3; row < 90; row += 5) {
      for (int column = -3; column < 90; column += 5) {
        std::uint8_t largest = 0;
        for (int y = row; y < row + side; ++y) {
          for (int x = column; x < column + side; ++x)
            largest = std::max(largest, field.at(0, x, y));
        }
        EXPECT_GE(field.at(level, std::max(column, 0), std::max(row, 0)),
                  column < 0 || row < 0 ? 0 : largest);
      }
    }
  }
}

}  // namespace
}  // namespace adit
