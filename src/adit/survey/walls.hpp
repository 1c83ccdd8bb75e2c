#pragma once

#include <functional>
#include <span>
#include <vector>

#include "adit/geometry/segment.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/survey/posed_scans.hpp"
#include "adit/survey/wall_options.hpp"

namespace adit {

/// What speaks for a wall.
struct WallSupport {
  double hits = 0.0;  ///< ends of beams on it
  int scans = 0;      ///< of the place that most scans met
  int visits = 0;     ///< of the place that was met on most visits
  double sure = 0.0;  ///< share of it that was met from near or on several visits
};

/// A straight piece of wall as surveyed, the open side on the left of the way from a to b.
struct SurveyedWall {
  Segment segment;
  /// Of its line: displacement across at the middle (m), turn about the middle (rad).
  Matrix2d covariance = Matrix2d::Zero();
  double scatter_m = 0.0;  ///< RMS distance of what was seen from the line
  WallSupport support;

  double offset_sigma_m() const { return std::sqrt(covariance(0, 0)); }
  double angle_sigma_rad() const { return std::sqrt(covariance(1, 1)); }
};

/// A wall from opening to opening: pieces that meet at vertices.
struct SurveyedWallLine {
  std::vector<Vector2d> vertices;     ///< of pieces, plus one; a closed line repeats its first
  std::vector<Matrix2d> covariances;  ///< of the vertices (m²)
  std::vector<SurveyedWall> pieces;
  bool closed = false;

  double length() const;
};

/// The walls of a surveyed place.
struct WallMap {
  std::vector<SurveyedWallLine> lines;

  /// All pieces, as a plan.
  std::vector<Segment> segments() const;
};

/// Says how far the work is, from 0 to 1; may be empty.
using SurveyProgress = std::function<void(double)>;

/// Turns scans with known poses, in the order in which they were taken, into walls.
///
/// What moves is dropped, layers of one wall become one, both sides of a thin wall stay; pieces
/// follow what was seen to within the tolerance and meet at vertices; gaps stay open. The scans are
/// gone through twice. Time is linear in the beams, memory in the area of walls and of the space
/// between them. The same scans give the same walls. Scans that were taken from one place can be
/// told by `visits`, one number for every scan, ascending: each place is one visit, and its scans
/// lend each other neighbours, up to 32 of them. Without it, or of another length, a visit is a
/// stretch of way. An Error where the scans cannot be read.
Result<WallMap> survey_walls(const PosedScans& scans, const ScannerModel& scanner,
                             const WallOptions& options = {}, std::span<const int> visits = {},
                             const SurveyProgress& progress = {});

/// The same of scans in memory.
WallMap survey_walls(std::span<const PosedScan> scans, const ScannerModel& scanner,
                     const WallOptions& options = {}, std::span<const int> visits = {},
                     const SurveyProgress& progress = {});

}  // namespace adit
