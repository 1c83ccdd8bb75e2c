#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "adit/tracking/estimate.hpp"
#include "statistics.hpp"

namespace adit {

/// Counts with one name that mean something else from now on ask for another number.
inline constexpr int kDefinitionsVersion = 1;

/// What an estimate is counted as.
enum class AnswerKind {
  answer,       ///< `ok` or `degraded`
  silent,       ///< `lost` or `ambiguous`
  unconfirmed,  ///< of a start that no scan has confirmed: neither answered nor silent
};

/// The one place that says so. No estimate names an unconfirmed start as its reason yet.
AnswerKind kind_of(const Estimate& estimate);

/// One estimate beside the truth.
struct JudgedAnswer {
  Status status = Status::lost;
  AnswerKind kind = AnswerKind::silent;
  Vector3d error = Vector3d::Zero();     ///< x, y (m, map axes), heading (rad)
  Vector3d variance = Vector3d::Zero();  ///< claimed, of the same
  double level_m = std::numeric_limits<double>::infinity();
  std::optional<double> level_rad;  ///< where the estimator states one
  double moved_m = 0.0;             ///< in truth, since the scan before
  double seconds = 0.0;             ///< of the cycle
  bool is_news = true;              ///< counts for the way until the pose is found

  double position_error() const { return error.head<2>().norm(); }
  double heading_error() const { return std::abs(error.z()); }
  bool is_answer() const { return kind == AnswerKind::answer; }
  /// An answer whose error exceeds its level.
  bool is_beyond() const;
  /// An answer that errs by more than max(1 m, level), or in its heading by more than
  /// max(5°, level).
  bool is_wrong() const;
  /// Within 1 m and 5° of the truth.
  bool is_right() const;
};

JudgedAnswer judged(const Estimate& estimate, const Pose2& truth, double moved_m, double seconds);

/// What one drive came to: a row of a result file. Where a cell looks for single scans, a drive is
/// some of them.
struct DriveCounts {
  std::int64_t drive = 0;
  std::int64_t scans = 0;
  std::int64_t ok = 0;
  std::int64_t degraded = 0;
  std::int64_t ambiguous = 0;
  std::int64_t lost = 0;
  std::int64_t unconfirmed = 0;
  std::int64_t answered = 0;
  std::int64_t beyond = 0;
  std::int64_t wrong = 0;
  std::int64_t untold = 0;
  std::int64_t first = 0;
  std::int64_t listed = 0;
  double metres = 0.0;
  double found_m = -1.0;
  std::int64_t judged = 0;
  double error_m = 0.0;
  double worst_m = 0.0;
  double nees_x = 0.0;
  double nees_y = 0.0;
  double nees_heading = 0.0;
  std::int64_t bounded = 0;
  double squares_m2 = 0.0;
  double bound_m2 = 0.0;
  Histogram levels;
  Histogram silences;
  Histogram seconds;

  bool operator==(const DriveCounts&) const = default;

  std::int64_t answers() const { return ok + degraded; }
  bool is_hit() const { return beyond > 0 || wrong > 0; }

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("drive", self.drive, "number of the drive");
    field("scans", self.scans, "estimates");
    field("ok", self.ok, "of them");
    field("degraded", self.degraded, "of them");
    field("ambiguous", self.ambiguous, "of them");
    field("lost", self.lost, "of them");
    field("unconfirmed", self.unconfirmed, "of an unconfirmed start, in none of the four before");
    field("answered", self.answered, "answers with a level of at most 1 m");
    field("beyond", self.beyond, "answers beyond their level");
    field("wrong", self.wrong, "wrong answers");
    field("untold", self.untold, "wrong answers that no scan can tell from the truth");
    field("first", self.first, "single scans whose first pose is right");
    field("listed", self.listed, "single scans of whose poses one is right");
    field("metres", self.metres, "way driven (m)");
    field("found_m", self.found_m, "way until `ok` and right (m); below 0 for never");
    field("judged", self.judged, "answers that are not wrong, to which the next sums belong");
    field("error_m", self.error_m, "sum of their position errors (m)");
    field("worst_m", self.worst_m, "largest position error of all answers (m)");
    field("nees_x", self.nees_x, "sum of squared errors over claimed variances");
    field("nees_y", self.nees_y, "likewise");
    field("nees_heading", self.nees_heading, "likewise");
    field("bounded", self.bounded, "answers that have a bound, to which the next two belong");
    field("squares_m2", self.squares_m2, "sum of their squared position errors (m²)");
    field("bound_m2", self.bound_m2, "sum of the bound's variances (m²)");
    field("levels", self.levels, "levels of all answers (m)");
    field("silences", self.silences, "lengths of silent stretches (m)");
    field("seconds", self.seconds, "times of the cycle (s)");
  }
};

/// Adds a drive's counts to those of others; its number and its way until found are left out, and
/// of the largest errors the larger counts.
void add_counts(const DriveCounts& counts, DriveCounts& sum);

/// Counts a drive's estimates one after the other.
class Counting {
 public:
  explicit Counting(std::int64_t drive) { counts_.drive = drive; }

  void add(const JudgedAnswer& answer);
  /// For the answer added last: the trace of the bound's covariance of the position (m²).
  void add_bound(const JudgedAnswer& answer, double bound_m2);
  /// The counts, a stretch of silence that is still on closed.
  DriveCounts finished() const;

 private:
  void count_answer(const JudgedAnswer& answer);
  void count_silence(const JudgedAnswer& answer);

  DriveCounts counts_;
  std::optional<double> silent_m_;  // of the stretch that is on
  double way_m_ = 0.0;              // since the pose is sought
  bool is_sought_ = false;
};

}  // namespace adit
