#pragma once

#include <span>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/survey/station_field.hpp"

namespace adit {

/// How far a station's beams went, by bearing: what lies nearer is open.
///
/// Of each narrow sector the nearest return of each scan, and the median of those over the scans,
/// so that what moves between them neither opens nor closes it; beams without return say nothing.
class StationSight {
 public:
  StationSight() = default;
  explicit StationSight(const Vector2d& eye) : eye_(eye) {}

  /// Adds a scan, turned by `turn` into the station's frame.
  void add(const LaserScan& scan, double turn, const ScannerModel& scanner);
  /// Ends the adding.
  void finish();
  bool is_empty() const { return ranges_.empty(); }

  /// Share of the points that beams of this sight went through by more than `through_m` across
  /// their surface: seen under headings that are right, only what moved away.
  double share_seen_through(std::span<const StationPoint> points, const Pose2& sight_from_points,
                            double through_m) const;

 private:
  /// No farther than this is it open at the bearing and beside it (m); 0 where nothing is known.
  double open_to(double bearing) const;

  Vector2d eye_ = Vector2d::Zero();           // of the scanner, in the station's frame
  std::vector<std::vector<float>> gathered_;  // of each sector, of each scan
  std::vector<double> ranges_;                // of each sector
};

}  // namespace adit
