// The steady state of the cycle allocates nothing: every way to the heap is counted.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <new>

#include "support/mockup_run.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define ADIT_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer)
#define ADIT_SANITIZED 1
#endif
#endif

namespace {
long allocations = 0;  // no thread but the test's
}  // namespace

#if defined(__GLIBC__) && !defined(ADIT_SANITIZED)
// operator new ends here as well, and so does Eigen, which does not use it.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
}
#else
// A sanitizer has a malloc of its own; what the standard library allocates is counted still.
void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif

namespace adit {
namespace {

/// Allocations of each stop of a run, by a localizer that has seen all of the run before.
std::vector<long> allocations_of(const Recording& recording, const LineMap& map,
                                 const LocalizerSettings& settings) {
  Localizer localizer(map, settings);
  std::vector<long> counts(recording.scans.size());
  for (const bool warm : {false, true}) {
    localizer.start(recording.first_guess.pose, recording.first_guess.covariance);
    for (std::size_t i = 0; i < recording.scans.size(); ++i) {
      const long before = allocations;
      localizer.add_odometry({recording.scans[i].stamp, recording.odometry[i]});
      localizer.add_gyro(recording.scans[i].stamp, recording.gyro[i]);
      localizer.update(recording.scans[i], recording.odometry[i]);
      if (warm) counts[i] = allocations - before;
    }
  }
  return counts;
}

TEST(Allocation, TheCounterCounts) {
  const long before = allocations;
  const auto number = std::make_unique<int>(4);
  const std::vector<double> vector(static_cast<std::size_t>(100 + *number));
  EXPECT_GE(allocations, before + 2);
#if defined(__GLIBC__) && !defined(ADIT_SANITIZED)
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 + *number, 3);
  EXPECT_GE(allocations, before + 3);
#endif
  EXPECT_EQ(vector.size(), 104u);
}

TEST(Allocation, TheSteadyStateAllocatesNothing) {
  const LineMap map = LineMap::build(mockup().plan);
  const Recording recording = test::record_mockup(31100, 8);
  for (const Consistency consistency : {Consistency::clique, Consistency::paper}) {
    for (const Weighting weighting : {Weighting::covariance, Weighting::points}) {
      LocalizerSettings settings = test::mockup_settings();
      settings.matching.consistency = consistency;
      settings.estimation.weighting = weighting;
      const std::vector<long> counts = allocations_of(recording, map, settings);
      for (std::size_t i = 0; i < counts.size(); ++i) EXPECT_EQ(counts[i], 0) << "at stop " << i;
    }
  }
}

// Buffers that one scan has grown serve the next, though it shows other features.
TEST(Allocation, FewScansGrowTheBuffers) {
  const LineMap map = LineMap::build(mockup().plan);
  Localizer localizer(map, test::mockup_settings());
  for (std::uint64_t seed = 31200; seed < 31210; ++seed) {
    const Recording recording = test::record_mockup(seed, 8);
    localizer.start(recording.first_guess.pose, recording.first_guess.covariance);
    long count = 0;
    for (std::size_t i = 0; i < recording.scans.size(); ++i) {
      const long before = allocations;
      localizer.update(recording.scans[i], recording.odometry[i]);
      count += allocations - before;
    }
    if (seed >= 31208) {
      EXPECT_LE(count, 4) << "in the run of seed " << seed;
    }
  }
}

}  // namespace
}  // namespace adit
