// The cycle must not allocate once its buffers have grown.
#include <gtest/gtest.h>

#include <vector>

#include "adit/prediction/prediction.hpp"
#include "support/allocations.hpp"

namespace adit {
namespace {

TEST(SteadyState, PredictionAllocatesNothing) {
  std::vector<Segment> segments;
  for (int x = 0; x < 60; x += 4) {
    for (int y = 0; y < 60; y += 4) {
      segments.push_back({Vector2d(x, y), Vector2d(x + 2, y)});
      segments.push_back({Vector2d(x + 2, y), Vector2d(x + 2, y + 2)});
    }
  }
  const LineMap map = LineMap::build(segments);
  Visibility visibility;
  FeatureList features;
  std::vector<double> ranges(1000);
  const auto drive = [&] {
    for (double x = 10.0; x < 50.0; x += 0.7) {
      const Vector2d observer(x, 31.0);
      visibility.sweep(map, observer, 40.0);
      visibility.ranges(0.0, kTwoPi / 1000.0, ranges);
      predict_features(map, visibility, observer, {}, features);
    }
  };
  drive();
  const long before = test::allocations();
  ASSERT_GT(before, 0);
  drive();
  EXPECT_EQ(test::allocations(), before);
  EXPECT_GT(features.size(), 0u);
}

}  // namespace
}  // namespace adit
