#include "adit/tracking/stamp_watch.hpp"

#include <cmath>

namespace adit {

StampOrder StampWatch::next(double stamp, const StampOptions& options) {
  const double step = last_ ? stamp - *last_ : 0.0;
  const bool is_first = !last_;
  last_ = stamp;
  step_s_ = 0.0;
  if (is_first) return StampOrder::first;
  const StampOrder order = classify(step, options);
  if (order != StampOrder::jump) step_s_ = step;
  return order;
}

StampOrder StampWatch::classify(double step, const StampOptions& options) {
  if (!(std::abs(step) <= options.jump_s)) {
    ++counts_.jumps;
    return StampOrder::jump;
  }
  if (step == 0.0) {
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
