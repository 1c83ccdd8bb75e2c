#include "adit/tracking/stamp_watch.hpp"

#include <cmath>

namespace adit {

StampOrder StampWatch::next(double stamp, int scanner, const StampOptions& options) {
  const bool same_scanner = scanner == last_scanner_;
  last_scanner_ = scanner;
  const double step = last_ ? stamp - *last_ : 0.0;
  const bool is_first = !last_;
  last_ = stamp;
  step_s_ = 0.0;
  if (is_first) return StampOrder::first;
  const StampOrder order = classify(step, same_scanner, options);
  if (order != StampOrder::jump) step_s_ = step;
  return order;
}

StampOrder StampWatch::classify(double step, bool same_scanner, const StampOptions& options) {
  if (!(std::abs(step) <= options.jump_s)) {
    ++counts_.jumps;
    return StampOrder::jump;
  }
  if (step == 0.0) {
    if (!same_scanner) return StampOrder::in_order;
    ++counts_.duplicates;
    return StampOrder::duplicate;
  }
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
