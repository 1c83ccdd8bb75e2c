#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "adit/evaluation/consistency.hpp"
#include "adit/evaluation/join.hpp"
#include "adit/evaluation/relations.hpp"
#include "adit/evaluation/sample.hpp"
#include "adit/evaluation/statistics.hpp"
#include "adit/motion/odometry.hpp"

namespace adit {

/// Where a run counts as lost, and how rows are joined.
struct EvaluationOptions {
  double join_tolerance_s = kJoinTolerance;
  double lost_position_m = 1.0;
  double lost_heading_rad = radians(20.0);

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field(
        "join_tolerance_s", self.join_tolerance_s,
        "rows whose stamps lie within this belong together (s); logs keep microseconds, scans lie "
        "tens of milliseconds apart");
    field("lost_position_m", self.lost_position_m,
          "a run is lost where its position error passes this (m); half a narrow drift");
    field("lost_heading_rad", self.lost_heading_rad,
          "a run is lost where its heading error passes this (rad)");
  }
};

/// What is to be judged, and by what; truth and relations may be empty.
struct EvaluationInput {
  std::span<const EstimateSample> estimates;  ///< in the order of the log
  std::span<const StampedPose> truth;         ///< map_from_vehicle
  std::span<const Relation> relations;
};

/// How often each status was given.
struct StatusCounts {
  std::int64_t ok = 0;
  std::int64_t degraded = 0;
  std::int64_t ambiguous = 0;
  std::int64_t lost = 0;

  std::int64_t& operator[](Status status) {
    switch (status) {
      case Status::ok:
        return ok;
      case Status::degraded:
        return degraded;
      case Status::ambiguous:
        return ambiguous;
      case Status::lost:
        break;
    }
    return lost;
  }
};

/// The protection level against the truth: how many rows gave one, and where the error exceeded it.
struct ProtectionCheck {
  std::int64_t count = 0;     ///< joined rows with a finite level
  std::int64_t exceeded = 0;  ///< of these, with a larger position error
  Statistics level;           ///< of the finite levels (m)
};

/// Everything that is known of a run; parts without data are absent, or not-a-number.
struct EvaluationReport {
  std::int64_t estimates = 0;      ///< rows given
  std::int64_t truth = 0;          ///< truth poses given
  std::int64_t joined = 0;         ///< rows that have a truth pose at their stamp: they are judged
  std::int64_t without_truth = 0;  ///< rows that have none
  std::int64_t missing = 0;        ///< truth poses with no row at their stamp
  std::int64_t not_finite = 0;     ///< joined rows whose pose is not finite; they err infinitely

  Statistics position;     ///< distance from the truth (m)
  Statistics heading_deg;  ///< absolute smallest turn from the truth (degrees)

  std::int64_t beyond_lost = 0;            ///< joined rows past the bounds of a lost run
  std::optional<double> first_lost_stamp;  ///< of the first of these in the order of the log
  std::int64_t confidently_wrong = 0;      ///< of these, with status `ok`

  std::optional<StatusCounts> by_status;      ///< all rows that state one
  std::optional<ConsistencyFigures> nees;     ///< all joined rows with a covariance
  std::optional<ConsistencyFigures> nees_ok;  ///< of these, the rows with status `ok`
  std::optional<ProtectionCheck> protection;
  std::optional<RelationsMetric> relations;
};

/// Judges a run by the rows that belong to a truth pose; relations are compared independently.
///
/// A row joins the truth pose nearest to its stamp, unless another row lies nearer to that pose:
/// logs hold scans less than a millisecond apart with the vehicle elsewhere. Repeated stamps are
/// all judged.
EvaluationReport evaluate(const EvaluationInput& input, const EvaluationOptions& options = {});

/// The report as a table for people, in lines that end with a newline.
std::string to_text(const EvaluationReport& report);

}  // namespace adit
