#include "adit/threads/share_out.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>

namespace adit {
namespace {

TEST(ShareOut, DoesAllOnAnyNumberOfThreads) {
  for (const int threads : {1, 3}) {
    std::vector<int> done(100, 0);
    share_out(done.size(), threads, [&] { return [&](std::size_t i) { ++done[i]; }; });
    for (const int times : done) EXPECT_EQ(times, 1);
  }
}

/// On a thread of its own as on the caller's: else the whole program would end.
TEST(ShareOut, AWorkersExceptionReachesTheCaller) {
  for (const int threads : {1, 4}) {
    std::atomic<int> begun{0};
    std::string said;
    try {
      share_out(100'000, threads, [&] {
        return [&](std::size_t) {
          ++begun;
          throw std::runtime_error("out of paper");
        };
      });
    } catch (const std::runtime_error& error) {
      said = error.what();
    }
    EXPECT_EQ(said, "out of paper");
    EXPECT_LE(begun, threads);
  }
}

TEST(ShareOut, AWorkerThatCannotBeMadeIsAnExceptionToo) {
  const auto share = [] {
    share_out(10, 2, [] {
      if (std::string("a").size() == 1) throw std::bad_alloc();
      return [](std::size_t) {};
    });
  };
  EXPECT_THROW(share(), std::bad_alloc);
}

}  // namespace
}  // namespace adit
