#pragma once

#include <optional>
#include <vector>

#include "adit/scan_motion/alignment.hpp"
#include "adit/scan_motion/correlative_search.hpp"
#include "adit/scan_motion/options.hpp"

namespace adit {

/// What a scan tells of the way: where it lies on the last ones that were kept.
struct ScanMove {
  bool is_found = false;     ///< else the scan tells nothing, and the poses are the predicted ones
  bool is_kept = false;      ///< whether the next scans are laid onto this one, too
  Pose2 frame_from_vehicle;  ///< in the frame in which the kept scans stand
  Pose2 last_from_vehicle;   ///< the move since the last scan that was found
  /// Of the scans alone, over (x, y, theta), in the axes of `frame` and in those of `last`; zero in
  /// a direction that walls leave open, and all zero where the scan was not found.
  Matrix3d information = Matrix3d::Zero();
  Matrix3d move_information = Matrix3d::Zero();
  int matched = 0;             ///< points that found a wall
  double matched_share = 0.0;  ///< of those with a normal
  double closeness = 0.0;      ///< how near to it they lie, in the mean: 1 on it, 0 without one
};

/// A scan that others are laid onto.
struct KeptScan {
  ScanShape shape;
  double beam_sigma_m = 0.0;
  Pose2 frame_from_vehicle;
};

/// Lays each scan onto the last few, from where dead reckoning puts it; needs no plan.
///
/// The first scan sets the frame, by the pose that is predicted for it. A scan is looked for around
/// the prediction in a grid of the kept ones, then laid onto them point to line. The prediction
/// decides only in directions in which walls do not hold the pose. A scan is kept after some way,
/// found or not: where nothing is seen, the next ones start from it.
class ScanMotion {
 public:
  explicit ScanMotion(const ScanMotionOptions& options = {}, const SurfaceOptions& surface = {},
                      const AlignmentOptions& alignment = {});

  /// The prediction for the next scan: by the move since the last one that was found, whose
  /// covariance is in that one's axes.
  PoseWithCovariance predict(const PoseWithCovariance& last_from_vehicle) const;

  /// Lays a scan, taken at one stamp, near a predicted frame_from_vehicle, which is finite.
  ScanMove lay(const LaserScan& scan, const ScannerModel& scanner,
               const PoseWithCovariance& predicted);

  /// Where the last scan was that was found (frame_from_vehicle), or the first.
  const Pose2& last() const { return last_; }
  /// Oldest first; the newest is the last that was laid with `is_kept`.
  const std::vector<KeptScan>& kept() const { return kept_; }

 private:
  /// What is known of a scan before it is laid.
  struct Guess {
    const ScanShape& shape;
    double beam_sigma_m;
    Pose2 predicted;
    Matrix3d covariance;
  };
  /// How well a scan lies, and whether that is believed.
  struct Fit {
    Alignment alignment;
    bool is_found = false;
  };

  Fit find(const Guess& guess);
  std::optional<Alignment> look_farther(const Guess& guess, SearchWindow window);
  Alignment align_from(const Guess& guess, const Pose2& start, const Pose2& prior) const;
  double closeness(const Guess& guess, const Pose2& pose) const;
  bool is_surprising(const Guess& guess, const Alignment& fit) const;
  bool is_sure(const Guess& guess, const Alignment& fit, double close_at_prediction) const;
  SearchWindow window_around(const Guess& guess) const;
  bool is_to_be_kept(const Pose2& frame_from_vehicle) const;
  void keep(ScanShape shape, double beam_sigma_m, const Pose2& frame_from_vehicle);

  ScanMotionOptions options_;
  SurfaceOptions surface_options_;
  AlignmentOptions alignment_options_;
  SurfaceMaker maker_;
  std::vector<KeptScan> kept_;
  SurfaceMap local_;  // of the kept scans, as is the next
  EvidenceField field_;
  CorrelativeSearch search_;
  Pose2 last_;
};

}  // namespace adit
