#pragma once

#include <vector>

#include "adit/geometry/moments.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/survey/posed_scan.hpp"
#include "adit/survey/wall_options.hpp"

namespace adit {

/// Where a beam met something that looks like a piece of wall, in the map.
struct WallHit {
  Vector2d point = Vector2d::Zero();
  Vector2d normal = Vector2d::UnitX();  ///< unit, towards the scanner
  double noise_variance = 0.0;          ///< across the wall, of this beam alone (m²)
  double pose_variance = 0.0;           ///< across the wall, common to the scan's beams (m²)
  double range = 0.0;                   ///< from the scanner (m)
};

/// Turns scans into hits; keeps its buffers from scan to scan.
class WallHitFinder {
 public:
  WallHitFinder(const ScannerModel& scanner, const WallOptions& options)
      : scanner_(scanner), options_(options) {}

  /// The hits of a scan. The normal at a beam is that of the line through its neighbours on the
  /// same surface; beams without neighbours (legs, edges, mixed ranges) are no hits.
  const std::vector<WallHit>& find(const PosedScan& posed);

 private:
  void gather_points(const LaserScan& scan);
  bool same_surface(std::size_t beam, double step) const;
  void add_run(const PosedScan& posed, const Pose2& map_from_laser, std::size_t begin,
               std::size_t end);
  LineFit line_around(std::size_t beam, std::size_t begin, std::size_t end, double reach);

  ScannerModel scanner_;
  WallOptions options_;
  std::vector<Vector2d> points_;  // laser frame
  std::vector<double> ranges_;    // below zero: no return
  std::vector<WallHit> hits_;
};

/// How far around a beam its surface is looked at (m): enough for a direction under this noise.
double surface_reach(const ScannerModel& scanner);

}  // namespace adit
