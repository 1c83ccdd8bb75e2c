#include "adit/map/cleaning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "adit/map/arrangement.hpp"
#include "adit/map/hilbert.hpp"
#include "adit/map/merging.hpp"
#include "adit/map/snapping.hpp"

namespace adit {
namespace {

// Farther out than any projected coordinate on Earth: taken for garbage, like infinity.
constexpr double kMaxCoordinate = 1e9;
constexpr double kMaxTolerance = 1e6;
// After snapping, what is left to resolve is resolved at this part of the snapping tolerance.
constexpr double kFineTolerance = 1e-3;
constexpr double kRoundings = 64.0;

bool is_usable(const Segment& s) {
  return s.is_finite() && s.a.cwiseAbs().maxCoeff() <= kMaxCoordinate &&
         s.b.cwiseAbs().maxCoeff() <= kMaxCoordinate;
}

// The walls that can be used, along the Hilbert curve: every later step then works on memory that
// lies together.
std::vector<Segment> usable_walls(std::span<const Segment> raw, MapReport& report) {
  std::vector<Segment> usable;
  usable.reserve(raw.size());
  for (const Segment& s : raw) {
    if (!is_usable(s)) {
      ++report.not_finite;
    } else if (s.a == s.b) {
      ++report.zero_length;
    } else {
      usable.push_back(s);
    }
  }
  std::vector<Segment> sorted;
  sorted.reserve(usable.size());
  for (const int i : hilbert_order(usable)) sorted.push_back(usable[static_cast<std::size_t>(i)]);
  return sorted;
}

CleaningTolerances tolerances_for(std::span<const Segment> walls, const LineMapOptions& options) {
  double largest = 1.0;
  for (const Segment& s : walls) {
    largest = std::max({largest, s.a.cwiseAbs().maxCoeff(), s.b.cwiseAbs().maxCoeff()});
  }
  const double rounding = kRoundings * std::numeric_limits<double>::epsilon() * largest;
  const auto usable = [](double value, double floor) {
    return value > floor ? std::min(value, kMaxTolerance) : floor;  // floor for not-a-number, too
  };
  CleaningTolerances tolerances;
  tolerances.fine = usable(kFineTolerance * options.snap_m, rounding);
  tolerances.snap = usable(options.snap_m, tolerances.fine);
  tolerances.merge_offset = usable(options.merge_offset_m, rounding);
  return tolerances;
}

}  // namespace

PlanGraph clean_plan(std::span<const Segment> raw, const LineMapOptions& options,
                     MapReport& report) {
  report = {};
  report.input = static_cast<std::int64_t>(raw.size());
  const std::vector<Segment> walls = usable_walls(raw, report);
  const CleaningTolerances tolerances = tolerances_for(walls, options);

  SnappedPlan snapped = snap_plan(walls, tolerances, report);
  PlanGraph plan = std::move(snapped.plan);
  resolve_meetings(plan, snapped.bent, tolerances.snap, tolerances, report);
  report.duplicates += drop_duplicates(plan);

  const std::vector<int> moved = merge_chains(plan, tolerances, report);
  resolve_meetings(plan, moved, 0.0, tolerances, report);
  report.duplicates += drop_duplicates(plan);
  return plan;
}

}  // namespace adit
