#include "counting.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "adit/geometry/angle.hpp"

namespace adit {
namespace {

constexpr double kRightMetres = 1.0;
constexpr double kRightRadians = radians(5.0);
constexpr double kUsefulLevel = 1.0;  // m

}  // namespace

AnswerKind kind_of(const Estimate& estimate) {
  const bool is_answer = estimate.status == Status::ok || estimate.status == Status::degraded;
  return is_answer ? AnswerKind::answer : AnswerKind::silent;
}

bool JudgedAnswer::is_beyond() const {
  if (!is_answer()) return false;
  // Not-a-number is beyond any level.
  return !(position_error() <= level_m) || (level_rad && !(heading_error() <= *level_rad));
}

bool JudgedAnswer::is_wrong() const {
  if (!is_answer()) return false;
  return !(position_error() <= std::max(kRightMetres, level_m)) ||
         !(heading_error() <= std::max(kRightRadians, level_rad.value_or(0.0)));
}

bool JudgedAnswer::is_right() const {
  return position_error() <= kRightMetres && heading_error() <= kRightRadians;
}

JudgedAnswer judged(const Estimate& estimate, const Pose2& truth, double moved_m, double seconds) {
  JudgedAnswer answer;
  answer.status = estimate.status;
  answer.kind = kind_of(estimate);
  answer.error = {estimate.pose.x - truth.x, estimate.pose.y - truth.y,
                  angle_between(truth.theta, estimate.pose.theta)};
  answer.variance = estimate.covariance.diagonal();
  answer.level_m = estimate.protection_m;
  answer.moved_m = moved_m;
  answer.seconds = seconds;
  return answer;
}

void add_counts(const DriveCounts& counts, DriveCounts& sum) {
  const std::int64_t drive = sum.drive;
  const double found_m = sum.found_m;
  const double worst_m = std::max(sum.worst_m, counts.worst_m);
  const auto add = [](const auto& value, auto& to) {
    if constexpr (std::is_same_v<std::remove_reference_t<decltype(to)>, Histogram>) {
      to.add(value);
    } else {
      to += value;
    }
  };
  // Two visits at once: the fields' addresses of the one, then of the other in the same order.
  std::vector<const void*> values;
  DriveCounts::visit(
      counts, [&](const char*, const auto& value, const char*) { values.push_back(&value); });
  std::size_t next = 0;
  DriveCounts::visit(sum, [&](const char*, auto& to, const char*) {
    using Field = std::remove_reference_t<decltype(to)>;
    add(*static_cast<const Field*>(values[next++]), to);
  });
  sum.drive = drive;
  sum.found_m = found_m;
  sum.worst_m = worst_m;
}

void Counting::add(const JudgedAnswer& answer) {
  ++counts_.scans;
  counts_.metres += answer.moved_m;
  counts_.seconds.add(answer.seconds);
  if (answer.kind == AnswerKind::unconfirmed) {
    ++counts_.unconfirmed;
  } else {
    counts_.ok += answer.status == Status::ok ? 1 : 0;
    counts_.degraded += answer.status == Status::degraded ? 1 : 0;
    counts_.ambiguous += answer.status == Status::ambiguous ? 1 : 0;
    counts_.lost += answer.status == Status::lost ? 1 : 0;
  }
  count_answer(answer);
  count_silence(answer);
  if (!answer.is_news || counts_.found_m >= 0.0) return;
  if (is_sought_) way_m_ += answer.moved_m;  // the first scan of the search took no way
  is_sought_ = true;
  if (answer.is_answer() && answer.status == Status::ok && answer.is_right()) {
    counts_.found_m = way_m_;
  }
}

void Counting::count_answer(const JudgedAnswer& answer) {
  if (!answer.is_answer()) return;
  counts_.levels.add(answer.level_m);
  counts_.worst_m = std::max(counts_.worst_m, answer.position_error());
  counts_.answered += answer.level_m <= kUsefulLevel ? 1 : 0;
  counts_.beyond += answer.is_beyond() ? 1 : 0;
  if (answer.is_wrong()) {
    ++counts_.wrong;
    return;
  }
  ++counts_.judged;
  counts_.error_m += answer.position_error();
  const Vector3d squares = answer.error.cwiseAbs2();
  const auto ratio = [&](int axis) {
    return answer.variance[axis] > 0.0 ? squares[axis] / answer.variance[axis] : 0.0;
  };
  counts_.nees_x += ratio(0);
  counts_.nees_y += ratio(1);
  counts_.nees_heading += ratio(2);
}

void Counting::count_silence(const JudgedAnswer& answer) {
  if (answer.kind == AnswerKind::silent) {
    silent_m_ = silent_m_.value_or(0.0) + answer.moved_m;
  } else if (silent_m_) {
    counts_.silences.add(*silent_m_);
    silent_m_.reset();
  }
}

void Counting::add_bound(const JudgedAnswer& answer, double bound_m2) {
  if (!answer.is_answer() || answer.is_wrong()) return;
  ++counts_.bounded;
  counts_.squares_m2 += answer.error.head<2>().squaredNorm();
  counts_.bound_m2 += bound_m2;
}

DriveCounts Counting::finished() const {
  DriveCounts counts = counts_;
  if (silent_m_) counts.silences.add(*silent_m_);
  return counts;
}

}  // namespace adit
