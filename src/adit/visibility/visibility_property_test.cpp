#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>
#include <vector>

#include "adit/visibility/visibility.hpp"
#include "support/casting.hpp"

namespace adit {
namespace {

using testing::agree;
using testing::barely_cleaned;
using testing::grid_segments;
using testing::is_right;
using testing::map_of;
using testing::Sight;

RC_GTEST_PROP(VisibilityLaw, AnyGridWorldIsSeenAsCast, ()) {
  const auto coordinates =
      *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 6)).as("x1 y1 x2 y2 ...");
  Sight sight;
  std::vector<Segment> segments;
  for (std::size_t i = 0; i + 3 < coordinates.size(); i += 4) {
    segments.push_back({Vector2d(coordinates[i], coordinates[i + 1]),
                        Vector2d(coordinates[i + 2], coordinates[i + 3])});
  }
  sight.map = map_of(segments);
  sight.observer = 0.5 * Vector2d(*rc::gen::inRange(0, 12), *rc::gen::inRange(0, 12));
  sight.max_range = *rc::gen::element(1.0, 3.0, 50.0);
  Visibility visibility;
  visibility.sweep(sight.map, sight.observer, sight.max_range);
  for (int i = 0; i < 100; ++i) {
    const double bearing = -kPi + 0.0628 * i;
    double range = 0.0;
    visibility.ranges(bearing, 1.0, {&range, 1});
    RC_ASSERT(is_right(range, sight.map, sight.observer, bearing, sight.max_range));
  }
}

RC_GTEST_PROP(VisibilityLaw, TurnsWithTheWorld, (int seed)) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::vector<Segment> segments = grid_segments(random, 15, 10);
  const LineMap map = barely_cleaned(segments);
  const Vector2d observer(3.3, 4.6);
  const double turn = 0.001 * *rc::gen::inRange(-3141, 3141);
  const Pose2 turned{-7.0, 11.0, turn};
  for (Segment& s : segments) s = {turned * s.a, turned * s.b};
  Visibility here;
  Visibility there;
  here.sweep(map, observer, 7.0);
  there.sweep(barely_cleaned(segments), turned * observer, 7.0);
  std::vector<double> a(360);
  std::vector<double> b(360);
  here.ranges(0.00123, radians(1.0), a);
  there.ranges(0.00123 + turn, radians(1.0), b);
  for (std::size_t i = 0; i < a.size(); ++i) {
    RC_ASSERT(agree(a[i], b[i], 1e-7) ||
              is_right(b[i], map, observer, 0.00123 + radians(static_cast<double>(i)), 7.0));
  }
}

}  // namespace
}  // namespace adit
