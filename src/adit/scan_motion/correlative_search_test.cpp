#include "adit/scan_motion/correlative_search.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "adit/scan_motion/alignment.hpp"
#include "adit/simulation/random.hpp"

namespace adit {
namespace {

/// The walls of a room of 6 m x 4 m with a corner cut off, as seen from inside.
ScanShape room() {
  ScanShape shape;
  const auto wall = [&](Eigen::Vector2f a, Eigen::Vector2f b) {
    const Eigen::Vector2f along = (b - a).normalized();
    const Eigen::Vector2f normal(-along.y(), along.x());
    for (float s = 0.0F; s < (b - a).norm(); s += 0.08F) {
      shape.points.push_back({a + s * along, normal});
    }
  };
  wall({-3, -2}, {3, -2});
  wall({3, -2}, {3, 1});
  wall({3, 1}, {1, 2});
  wall({1, 2}, {-3, 2});
  wall({-3, 2}, {-3, -2});
  return shape;
}

/// The room as seen by somebody who stands elsewhere in it.
ScanShape seen_from(const Pose2& pose) {
  ScanShape shape = room();
  const RigidTransform carry_by(inverse(pose));
  for (SurfacePoint& p : shape.points) p = carry(carry_by, p);
  return shape;
}

/// The same points as a scanner reports them: no wall lies along the edges of cells.
ScanShape noisy(ScanShape shape, Random& random) {
  constexpr double kSigma = 0.03;  // m
  for (SurfacePoint& p : shape.points) {
    p.point += (kSigma * Vector2d(random.normal(), random.normal())).cast<float>();
  }
  return shape;
}

double score_at(const EvidenceField& field, const ScanShape& shape, const Pose2& pose) {
  const RigidTransform carry_by(pose);
  double sum = 0.0;
  for (const SurfacePoint& p : shape.points) {
    const Vector2d point = carry_by.point(p.point.cast<double>());
    sum += field.at(0, field.column(point.x()), field.row(point.y())) / 255.0;
  }
  return sum / static_cast<double>(shape.points.size());
}

RC_GTEST_PROP(CorrelativeSearch, FindsWhatABruteForceSearchFinds, ()) {
  const Pose2 truth{*rc::gen::inRange(-80, 80) * 0.01, *rc::gen::inRange(-80, 80) * 0.01,
                    *rc::gen::inRange(-30, 30) * 0.01};
  const ScanShape here = room();
  const ScanShape there = seen_from(truth);
  EvidenceField field;
  const PlacedShape target{&here, {}};
  field.build({&target, 1}, true, {});
  CorrelativeSearch search;
  const PlacedShape query{&there, {}};
  search.set_points({&query, 1}, field);
  // A prior so wide that it costs next to nothing.
  const SearchWindow window{{}, 1.0, 0.4, 1e3, 1e3};
  const auto found = search.best(field, window, 0.0);
  RC_ASSERT(found.has_value());
  const Vector3d off = difference(truth, found->pose);
  RC_ASSERT(off.head<2>().norm() < 0.15);
  RC_ASSERT(std::abs(off.z()) < 0.06);
  for (int i = 0; i < 400; ++i) {
    const Pose2 other{*rc::gen::inRange(-10, 11) * 0.1, *rc::gen::inRange(-10, 11) * 0.1,
                      *rc::gen::inRange(-13, 14) * 0.03};
    RC_ASSERT(score_at(field, there, other) <= found->score + 0.12);
  }
}

/// The best of every pose of the search's own grid in a window.
double best_in_window(const EvidenceField& field, const ScanShape& shape,
                      const SearchWindow& window, double step_rad) {
  const int reach = static_cast<int>(std::ceil(window.reach_m / field.cell_m()));
  const int angles = static_cast<int>(std::ceil(window.reach_rad / step_rad));
  double best = 0.0;
  for (int a = -angles; a <= angles; ++a) {
    for (int row = -reach; row <= reach; ++row) {
      for (int column = -reach; column <= reach; ++column) {
        Pose2 pose = window.middle;
        pose.theta += a * step_rad;
        const RigidTransform carry_by(pose);
        double sum = 0.0;
        for (const SurfacePoint& p : shape.points) {
          const Vector2d at = carry_by.point(p.point.cast<double>());
          sum += field.at(0, field.column(at.x()) + column, field.row(at.y()) + row) / 255.0;
        }
        best = std::max(best, sum / static_cast<double>(shape.points.size()));
      }
    }
  }
  return best;
}

/// Also where something better lies just beyond the window.
RC_GTEST_PROP(CorrelativeSearch, FindsTheBestOfItsWindowExactly, ()) {
  constexpr double kLeastRadius = 2.0;  // m: points nearer than this turn as those there
  ScanShape shape;
  for (int i = 0; i < 6; ++i) {  // no two points in one cell
    shape.points.push_back({Vector2d(-1.05 + 0.4 * i, -0.85).cast<float>(), {0.0F, 1.0F}});
    shape.points.push_back({Vector2d(-1.25, -0.65 + 0.3 * i).cast<float>(), {1.0F, 0.0F}});
  }
  EvidenceField field;
  const PlacedShape target{&shape, {}};
  field.build({&target, 1}, true, {});
  CorrelativeSearch search;
  search.set_points({&target, 1}, field);
  RC_ASSERT(search.size() == shape.points.size());
  const Pose2 middle{*rc::gen::inRange(-120, 120) * 0.01, *rc::gen::inRange(-120, 120) * 0.01,
                     *rc::gen::inRange(-20, 20) * 0.01};
  const SearchWindow window{middle, *rc::gen::inRange(3, 10) * 0.1 - 0.05, 0.1, 1e3, 1e3};
  const auto found = search.best(field, window, 0.0);
  RC_ASSERT(found.has_value());
  const double step_rad = field.cell_m() / kLeastRadius;
  RC_ASSERT(std::abs(found->score - best_in_window(field, shape, window, step_rad)) < 1e-4);
  const double reach = std::ceil(window.reach_m / field.cell_m()) * field.cell_m() + 1e-9;
  RC_ASSERT(std::abs(found->pose.x - middle.x) < reach);
  RC_ASSERT(std::abs(found->pose.y - middle.y) < reach);
}

TEST(CorrelativeSearch, FindsTheTwinElsewhere) {
  // Two rooms alike, 8 m apart.
  Random random(5);
  const ScanShape one = noisy(room(), random);
  const ScanShape other = noisy(room(), random);
  const ScanShape seen = noisy(room(), random);
  EvidenceField field;
  const std::vector<PlacedShape> twins = {{&one, {}}, {&other, {8.0, 0.0, 0.0}}};
  field.build(twins, true, {});
  CorrelativeSearch search;
  const PlacedShape query{&seen, {}};
  search.set_points({&query, 1}, field);
  const SearchWindow window{{4.0, 0.0, 0.0}, 5.0, 0.1, 1e3, 1e3};
  const auto best = search.best(field, window, 0.5);
  ASSERT_TRUE(best.has_value());
  const auto rival = search.best(field, window, best->with_prior - 0.05, &best->pose, 1.0, 0.4);
  ASSERT_TRUE(rival.has_value());
  EXPECT_NEAR((rival->pose.translation() - best->pose.translation()).norm(), 8.0, 0.3);
}

TEST(CorrelativeSearch, FindsNothingBelowTheLeastScore) {
  const ScanShape here = room();
  EvidenceField field;
  const PlacedShape target{&here, {}};
  field.build({&target, 1}, true, {});
  CorrelativeSearch search;
  const PlacedShape query{&here, {}};
  search.set_points({&query, 1}, field);
  const SearchWindow far{{40.0, 40.0, 0.0}, 1.0, 0.1, 1e3, 1e3};
  EXPECT_FALSE(search.best(field, far, 0.5).has_value());
}

RC_GTEST_PROP(Alignment, BringsPointsHome, ()) {
  const Pose2 truth{*rc::gen::inRange(-15, 15) * 0.01, *rc::gen::inRange(-15, 15) * 0.01,
                    *rc::gen::inRange(-6, 6) * 0.01};
  SurfaceMap map;
  map.add(room().points, RigidTransform(Pose2{}));
  map.index();
  const Alignment fit = align(seen_from(truth).points, map, {{}, Matrix3d::Zero()}, {}, 0.01, {});
  const Vector3d off = difference(truth, fit.target_from_source);
  RC_ASSERT(off.head<2>().norm() < 0.01);
  RC_ASSERT(std::abs(off.z()) < 0.005);
  RC_ASSERT(fit.matched_share > 0.9);
}

/// Between two walls nothing says how far along them one is, however their normals scatter.
TEST(Alignment, LeavesToThePriorWhatWallsDoNotTell) {
  Random random(3);
  const auto gallery = [&](double from) {
    std::vector<SurfacePoint> points;
    for (double x = from; x < from + 12.0; x += 0.07) {
      for (const double side : {-1.0, 1.0}) {
        const Vector2d normal = unit_vector(-side * 0.5 * kPi + 0.05 * random.normal());
        points.push_back(
            {Vector2d(x, side * 1.2 + 0.01 * random.normal()).cast<float>(), normal.cast<float>()});
      }
    }
    return points;
  };
  SurfaceMap map;
  map.add(gallery(-8.0), RigidTransform(Pose2{}));
  map.index();
  PosePrior prior{{0.25, 0.0, 0.0}, Matrix3d::Zero()};
  prior.information.diagonal() << 400.0, 1.0, 1.0;
  const Alignment fit = align(gallery(-6.0), map, prior, {0.25, 0.05, 0.01}, 0.01, {});
  EXPECT_NEAR(fit.target_from_source.x, 0.25, 0.01);
  EXPECT_NEAR(fit.target_from_source.y, 0.0, 0.01);
  EXPECT_NEAR(fit.target_from_source.theta, 0.0, 0.005);
  EXPECT_LT(fit.information(0, 0), 0.01 * fit.information(1, 1));
}

}  // namespace
}  // namespace adit
