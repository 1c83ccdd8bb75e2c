#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace adit {

/// Calls `work(i)` for 0 .. count - 1 on so many threads, each with a `work` of its own that
/// `make_worker` makes. What is done for `i` must not depend on who does it.
template <class MakeWorker>
void share_out(std::size_t count, int threads, const MakeWorker& make_worker) {
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    auto work = make_worker();
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::thread> pool;
  for (int i = 1; i < threads && static_cast<std::size_t>(i) < count; ++i) pool.emplace_back(run);
  run();
  for (std::thread& thread : pool) thread.join();
}

/// The number of threads asked for, or that of the machine's cores.
inline int threads_or_cores(int threads) {
  if (threads > 0) return threads;
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace adit
