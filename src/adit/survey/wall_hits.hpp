#pragma once

#include <optional>
#include <span>
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

/// A beam that met something of which it does not tell the direction.
struct LoneBeam {
  Vector2d point = Vector2d::Zero();  ///< in the map
  double range = 0.0;                 ///< from the scanner (m)
};

/// Turns scans into hits; keeps its buffers from scan to scan.
class WallHitFinder {
 public:
  WallHitFinder(const ScannerModel& scanner, const WallOptions& options)
      : scanner_(scanner), options_(options) {}

  /// The hits of a scan. The normal at a beam is that of the line through its neighbours on the
  /// same surface; beams without neighbours (legs, edges, mixed ranges) are no hits.
  const std::vector<WallHit>& find(const PosedScan& posed);

  /// Of the scan of the last `find`: the beams that met something but have no neighbours.
  const std::vector<LoneBeam>& lone() const { return lone_; }

  /// The hit of a beam that met a surface which lies along this direction of the map; nothing where
  /// it met it too flat.
  std::optional<WallHit> hit_along(const PosedScan& posed, const LoneBeam& beam,
                                   const Vector2d& direction) const;

 private:
  void gather_points(const LaserScan& scan);
  bool same_surface(std::size_t beam, double step) const;
  void add_run(const PosedScan& posed, const Pose2& map_from_laser, std::size_t begin,
               std::size_t end);
  void add_lone(const Pose2& map_from_laser, std::size_t begin, std::size_t end);
  LineFit line_around(std::size_t beam, std::size_t begin, std::size_t end, double reach);

  ScannerModel scanner_;
  WallOptions options_;
  std::vector<Vector2d> points_;  // laser frame
  std::vector<double> ranges_;    // below zero: no return
  std::vector<WallHit> hits_;
  std::vector<LoneBeam> lone_;
};

/// Turns scans that were taken from one place into hits. Beams that have no neighbours in their own
/// scan, as far and flat walls are met by few, may have them in the others.
class PlaceHitFinder {
 public:
  PlaceHitFinder(const ScannerModel& scanner, const WallOptions& options)
      : scanner_(scanner), finder_(scanner, options) {}

  /// The hits of each scan; those of a scan alone are those of WallHitFinder.
  const std::vector<std::vector<WallHit>>& find(std::span<const PosedScan> scans);

 private:
  ScannerModel scanner_;
  WallHitFinder finder_;
  std::vector<std::vector<WallHit>> hits_;
  std::vector<std::vector<LoneBeam>> lone_;
};

/// How far around a beam its surface is looked at (m): enough for a direction under this noise.
double surface_reach(const ScannerModel& scanner);

}  // namespace adit
