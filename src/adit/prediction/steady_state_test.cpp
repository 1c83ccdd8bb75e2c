// The cycle must not allocate once its buffers have grown: counted by replacing operator new.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <vector>

#include "adit/prediction/prediction.hpp"

namespace {
long allocations = 0;
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

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
  const long before = allocations;
  ASSERT_GT(before, 0);
  drive();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(features.size(), 0u);
}

}  // namespace
}  // namespace adit
