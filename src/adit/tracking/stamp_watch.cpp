#include "adit/tracking/stamp_watch.hpp"

#include <cmath>

namespace adit {

StampOrder StampWatch::next(double stamp, int scanner, const StampOptions& options) {
  std::optional<double>& own = last_of_[static_cast<std::size_t>(scanner) % kScanners];
  const bool repeated = own == stamp;
  own = stamp;
  const double step = last_ ? stamp - *last_ : 0.0;
  const bool is_first = !last_;
  last_ = stamp;
  step_s_ = 0.0;
  if (is_first) return StampOrder::first;
  const StampOrder order = classify(step, repeated, options);
  if (order != StampOrder::jump) step_s_ = step;
  return order;
}

StampOrder StampWatch::classify(double step, bool repeated, const StampOptions& options) {
  if (!(std::abs(step) <= options.jump_s)) {
    ++counts_.jumps;
    return StampOrder::jump;
  }
  if (repeated) {
    ++counts_.duplicates;
    return StampOrder::duplicate;
  }
  if (step == 0.0) return StampOrder::in_order;
  if (step < 0.0) {
    ++counts_.late;
    return StampOrder::late;
  }
  if (step > options.gap_s) {
    ++counts_.gaps;
    return StampOrder::gap;
  }
  return StampOrder::in_order;
}

}  // namespace adit
