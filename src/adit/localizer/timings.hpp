#pragma once

#include <chrono>

namespace adit {

/// How long the stages of one turn of the cycle took (s).
struct Timings {
  double deskew = 0.0;
  double prediction = 0.0;
  double extraction = 0.0;
  double matching = 0.0;
  double estimation = 0.0;
  double refinement = 0.0;
  double search = 0.0;
  double tracking = 0.0;  ///< prediction of the pose, fusion, beginning a search, judgement
  double total() const {
    return deskew + prediction + extraction + matching + estimation + refinement + search +
           tracking;
  }
};

/// Adds the life time of the object to `seconds`.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), start_(Clock::now()) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point start_;
};

/// Adds the time since the last call, or its making, to one sum after the other.
class LapTimer {
 public:
  void add_to(double& seconds) {
    const Clock::time_point now = Clock::now();
    seconds += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  void skip() { last_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace adit
