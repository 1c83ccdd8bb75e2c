#pragma once

#include <cstddef>
#include <span>

#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/scanner.hpp"

namespace adit {

/// How much more likely scans are from where they were taken than from where they are believed to
/// have been taken, for one who knows the mine and how the scanner errs, and of clutter only that
/// there is some.
///
/// Beams err independently of each other, as the simulator draws them. A beam meets its wall with
/// the scanner's noise, or is shorter by clutter (uniform up to the wall), or brings anything at
/// all. Two poses are compared as places: each is moved by at most half of what makes an answer
/// wrong (0.5 m, 2.5°) to where it suits the scan best, so that centimetres do not speak for the
/// truth along a drift that looks the same everywhere; poses nearer to each other than that are one
/// place.
class ScanOracle {
 public:
  /// `mine` must outlive it: the walls that stand, without clutter.
  ScanOracle(const RayCaster& mine, const ScannerSpec& scanner) : mine_(mine), scanner_(scanner) {}

  /// log p(scan | place of the truth) - log p(scan | place that is believed); 0 for one place.
  double lead_of_truth(const LaserScan& scan, const Pose2& truth, const Pose2& believed) const;

  /// log p(scan | map_from_vehicle).
  double log_likelihood(const LaserScan& scan, const Pose2& map_from_vehicle) const;

 private:
  double best_near(const LaserScan& scan, const Pose2& map_from_vehicle) const;
  double beam(double measured, double expected) const;

  const RayCaster& mine_;
  ScannerSpec scanner_;
};

/// The lead (nats) from which scans tell the truth from another place.
inline constexpr double kTellingLead = 7.0;

/// Sums leads up, scan by scan since a fault, until they are so large that no later scan matters.
class LeadSum {
 public:
  void add(double lead) { lead_ += lead; }
  bool tells() const { return lead_ >= kTellingLead; }
  /// A lead that a few scans do not undo: what follows need not be looked at.
  bool is_settled() const { return lead_ >= kSettled; }

 private:
  static constexpr double kSettled = 300.0;
  double lead_ = 0.0;
};

}  // namespace adit
