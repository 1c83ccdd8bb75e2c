#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace adit {

/// Calls `work(i)` for 0 .. count - 1 on so many threads, each with a `work` of its own that
/// `make_worker` makes. What is done for `i` must not depend on who does it. The first exception
/// that leaves a worker ends the work and leaves this function; threads that the system refuses to
/// start are done without.
template <class MakeWorker>
void share_out(std::size_t count, int threads, const MakeWorker& make_worker) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stopped{false};
  std::exception_ptr failure;
  std::mutex failing;
  const auto run = [&]() noexcept {
    try {
      auto work = make_worker();
      for (std::size_t i = next++; i < count && !stopped; i = next++) work(i);
    } catch (...) {
      stopped = true;
      const std::lock_guard<std::mutex> lock(failing);
      if (!failure) failure = std::current_exception();
    }
  };
  std::vector<std::thread> pool;
  pool.reserve(std::min(count, static_cast<std::size_t>(std::max(1, threads))));
  for (int i = 1; i < threads && static_cast<std::size_t>(i) < count; ++i) {
    try {
      pool.emplace_back(run);
    } catch (...) {
      break;
    }
  }
  run();
  for (std::thread& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

/// The number of threads asked for, or that of the machine's cores.
inline int threads_or_cores(int threads) {
  if (threads > 0) return threads;
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace adit
