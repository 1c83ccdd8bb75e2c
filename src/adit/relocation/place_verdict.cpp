#include "adit/relocation/place_verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "adit/scan/returns.hpp"

namespace adit {
namespace {

// The lead that chance makes shrinks with this power of the part of a turn that a scan sees.
constexpr double kPerTurn = 2.5;

/// How much longer a lead chance makes than in a mine of as many places as where that was measured:
/// the more there are, the more resemble a scan.
double lead_of_size(std::size_t places) {
  constexpr double kMeasuredPlaces = 1.3e5;
  constexpr double kPerFold = 2.5;  // a lead that is longer by this is e times rarer
  return kPerFold * std::log(std::max(1.0, static_cast<double>(places) / kMeasuredPlaces));
}

double asked_lead(const RelocationResult& found, const RelocationQuery& query, std::size_t places,
                  const RelocationOptions& options) {
  const BeamShares& shares = found.shares;
  const FitQuality& quality = found.poses.front().quality;
  const double unexplained = std::max(0.0, 1.0 - quality.evidence_ratio);
  const int lines_short = std::max(0, options.enough_lines - found.lines);
  return options.sure_gap + lead_of_size(places) + options.sure_gap_per_line * lines_short +
         options.sure_gap_per_through * (shares.through + shares.unmapped) +
         options.sure_gap_per_behind * quality.behind_ratio +
         options.sure_gap_per_missing * shares.missing +
         options.sure_gap_per_error * error_ratio(found.map_error, query.map_error) +
         options.sure_gap_per_evidence * unexplained * unexplained;
}

/// What all poses weigh that are not the best one. At one place, but turned by more than what would
/// have become one with it: no less a rival.
double weight_of_rivals(const RelocationResult& found, const RelocationOptions& options) {
  double weight = 0.0;
  for (const RankedPose& pose : found.poses) {
    const bool is_best =
        is_near(found.poses.front().pose, pose.pose, options.apart_m, options.merge_rad);
    if (!is_best) weight += pose.weight;
  }
  return weight;
}

}  // namespace

double error_ratio(const MapError& error, const MapError& stated) {
  return stated.sigma_m() > 0.0 ? error.sigma_m() / stated.sigma_m() : 0.0;
}

double turn_in_sight(const LaserScan& scan, const ScannerModel& scanner) {
  constexpr std::size_t kMostSectors = 72;
  // Half as many as a turn has beams, so that none falls between two of them.
  const double beams = kTwoPi / std::max(1e-6, std::abs(scan.bearing_step));
  const auto sectors =
      static_cast<std::size_t>(std::clamp(0.5 * beams, 1.0, static_cast<double>(kMostSectors)));
  std::array<bool, kMostSectors> seen{};
  const ReturnLimits limits = return_limits(scan, scanner);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!limits.is_return(scan.ranges[i])) continue;
    const double turns = scan.bearing(i) / kTwoPi;
    const auto sector =
        static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(sectors));
    seen[std::min(sector, sectors - 1)] = true;
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) /
         static_cast<double>(sectors);
}

Status judge_place(const RelocationResult& found, const RelocationQuery& query, std::size_t places,
                   const RelocationOptions& options, const StatusOptions& status) {
  if (found.poses.empty()) return Status::lost;
  const RankedPose& best = found.poses.front();
  if (best.quality.returns < status.fewest_returns || !explains(best.quality, status)) {
    return Status::lost;
  }
  if (weight_of_rivals(found, options) > options.rival_weight) return Status::ambiguous;
  const double whole_turn = std::pow(turn_in_sight(query.scan, query.scanner), kPerTurn);
  const bool stands_alone = whole_turn * found.gap >= asked_lead(found, query, places, options);
  if (!stands_alone) return Status::ambiguous;
  return open_direction(best.covariance, status) ? Status::degraded : Status::ok;
}

}  // namespace adit
