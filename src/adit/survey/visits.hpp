#pragma once

#include <span>

#include "adit/survey/posed_scan.hpp"

namespace adit {

/// The visit of one scan after another: as given, else a new one begins where the vehicle has gone
/// `visit_m` since the last began.
class Visits {
 public:
  Visits(std::span<const int> given, double visit_m) : given_(given), visit_m_(visit_m) {}

  int next(const Pose2& map_from_vehicle) {
    const std::size_t scan = scan_++;
    if (!given_.empty()) return given_[scan];
    const Vector2d here = map_from_vehicle.translation();
    if (scan == 0) last_ = here;
    const double step = (here - last_).norm();
    // The jitter of a machine that stands is no way: less than this counts when it has added up.
    if (step >= 0.1 * visit_m_) {
      way_m_ += step;
      last_ = here;
    }
    return static_cast<int>(way_m_ / visit_m_);
  }

 private:
  std::span<const int> given_;
  double visit_m_;
  std::size_t scan_ = 0;
  double way_m_ = 0.0;
  Vector2d last_ = Vector2d::Zero();
};

}  // namespace adit
