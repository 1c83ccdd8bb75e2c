#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "adit/prediction/prediction.hpp"
#include "support/casting.hpp"
#include "support/draws.hpp"

namespace adit {
namespace {

using testing::barely_cleaned;

/// Rectangular pillars and loose walls at random places.
std::vector<Segment> random_world(std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-12.0, 12.0);
  std::uniform_real_distribution<double> size(1.0, 4.0);
  std::vector<Segment> segments;
  const std::size_t pillars = random() % 8;
  for (std::size_t i = 0; i < pillars; ++i) {
    const Pose2 pose{place(random), place(random), place(random)};
    const double width = size(random);
    const double height = size(random);
    const Vector2d c[] = {pose * Vector2d(0, 0), pose * Vector2d(width, 0),
                          pose * Vector2d(width, height), pose * Vector2d(0, height)};
    for (std::size_t k = 0; k < 4; ++k) segments.push_back({c[k], c[(k + 1) % 4]});
  }
  const std::size_t loose = random() % 5;
  for (std::size_t i = 0; i < loose; ++i) {
    const Vector2d a = test::drawn<2>([&] { return place(random); });
    segments.push_back({a, a + test::drawn<2>([&] { return size(random); })});
  }
  return segments;
}

struct Hit {
  double range = std::numeric_limits<double>::infinity();
  int wall = -1;
};

Hit cast(const LineMap& map, const Vector2d& observer, double bearing) {
  Hit hit;
  const Vector2d direction = unit_vector(bearing);
  for (std::size_t i = 0; i < map.walls().size(); ++i) {
    const Segment& wall = map.walls()[i].segment;
    const Vector2d along = wall.b - wall.a;
    const Vector2d to_a = wall.a - observer;
    const double turn = cross(direction, along);
    const double range = cross(to_a, along) / turn;
    const double share = cross(to_a, direction) / turn;
    if (range > 0.0 && share >= 0.0 && share <= 1.0 && range < hit.range) {
      hit = {range, static_cast<int>(i)};
    }
  }
  return hit;
}

bool ends_at(const LineMap& map, int wall, int vertex) {
  if (wall < 0) return false;
  const Wall& w = map.walls()[static_cast<std::size_t>(wall)];
  return w.vertex_a == vertex || w.vertex_b == vertex;
}

/// What beams just beside a vertex say about it.
struct Expected {
  bool corner = false;
  bool occluding = false;
  bool arm_before = false;
  bool arm_after = false;
};

Expected expected_at(const LineMap& map, int vertex, const Vector2d& observer) {
  constexpr double kBeside = 1e-10;
  const Vector2d to_vertex = map.vertices()[static_cast<std::size_t>(vertex)] - observer;
  const double bearing = std::atan2(to_vertex.y(), to_vertex.x());
  const Hit before = cast(map, observer, bearing - kBeside);
  const Hit after = cast(map, observer, bearing + kBeside);
  const double range = to_vertex.norm();
  Expected out;
  out.arm_before =
      ends_at(map, before.wall, vertex) && std::abs(before.range - range) < 1e-5 * range;
  out.arm_after = ends_at(map, after.wall, vertex) && std::abs(after.range - range) < 1e-5 * range;
  if (out.arm_before && out.arm_after) {
    const auto direction = [&](int wall) {
      const Wall& w = map.walls()[static_cast<std::size_t>(wall)];
      return Vector2d((w.vertex_a == vertex ? 1.0 : -1.0) * (w.segment.b - w.segment.a))
          .normalized();
    };
    out.corner = direction(before.wall).dot(direction(after.wall)) > std::cos(kPi - 0.05);
  } else if (out.arm_before || out.arm_after) {
    out.occluding = (out.arm_before ? after : before).range > range;
    out.corner = out.occluding;
  }
  return out;
}

RC_GTEST_PROP(PredictionLaw, CornersAreWhatBeamsBesideThemSee, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  const LineMap map = barely_cleaned(random_world(random));
  const Vector2d observer(0.123, -0.456);
  PredictionOptions all;
  all.min_line_m = 0.0;
  all.min_line_rad = 0.0;
  all.straight_m = 0.0;
  Visibility visibility;
  visibility.sweep(map, observer, 1000.0);
  FeatureList features;
  predict_features(map, visibility, observer, all, features);
  std::vector<const Corner*> found(map.vertices().size(), nullptr);
  for (const Corner& corner : features.corners) {
    RC_ASSERT(found[static_cast<std::size_t>(corner.vertex)] == nullptr);
    found[static_cast<std::size_t>(corner.vertex)] = &corner;
  }
  for (std::size_t v = 0; v < found.size(); ++v) {
    const Expected expected = expected_at(map, static_cast<int>(v), observer);
    RC_ASSERT(expected.corner == (found[v] != nullptr));
    if (!expected.corner) continue;
    RC_ASSERT(found[v]->occluding == expected.occluding);
    RC_ASSERT((found[v]->arms[0] >= 0) == expected.arm_before);
    RC_ASSERT((found[v]->arms[1] >= 0) == expected.arm_after);
  }
}

bool same_angle(std::optional<double> a, std::optional<double> b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return std::abs(angle_between(*a, *b)) < 1e-6;
}

RC_GTEST_PROP(PredictionLaw, MovesWithTheWorld, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  std::vector<Segment> segments = random_world(random);
  std::uniform_real_distribution<double> any(-kPi, kPi);
  const Pose2 moved{any(random), any(random), any(random)};
  const Vector2d observer(0.123, -0.456);
  const auto predict = [](const std::vector<Segment>& world, const Vector2d& from) {
    const LineMap map = barely_cleaned(world);
    Visibility visibility;
    visibility.sweep(map, from, 30.0);
    FeatureList features;
    predict_features(map, visibility, from, {}, features);
    return features;
  };
  FeatureList turned;
  transform(predict(segments, observer), Pose2{0.0, 0.0, moved.theta}, turned);
  for (Segment& s : segments) s = {moved * s.a, moved * s.b};
  const FeatureList there = predict(segments, moved * observer);
  RC_ASSERT(there.corners.size() == turned.corners.size());
  RC_ASSERT(there.lines.size() == turned.lines.size());
  for (const Corner& a : turned.corners) {
    RC_ASSERT(std::any_of(there.corners.begin(), there.corners.end(), [&](const Corner& b) {
      return (a.position - b.position).norm() < 1e-6 && a.occluding == b.occluding &&
             same_angle(a.concave_angle, b.concave_angle) && same_angle(a.bisector, b.bisector);
    }));
  }
  for (const Line& a : turned.lines) {
    RC_ASSERT(std::any_of(there.lines.begin(), there.lines.end(), [&](const Line& b) {
      return (a.begin - b.begin).norm() < 1e-6 && (a.end - b.end).norm() < 1e-6 &&
             same_angle(a.orientation, b.orientation) && std::abs(a.distance - b.distance) < 1e-6;
    }));
  }
}

}  // namespace
}  // namespace adit
