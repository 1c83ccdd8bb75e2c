#pragma once

#include <memory>
#include <span>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/map/line_map.hpp"
#include "adit/motion/twist.hpp"
#include "adit/refinement/options.hpp"
#include "adit/refinement/sweep_path.hpp"
#include "adit/refinement/wall_neighbours.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/returns.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/scan/sweep_timing.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {

/// One beam against the wall that the map has in its way.
struct BeamResidual {
  double residual = 0.0;                  ///< measured minus predicted range (m)
  double measured = 0.0;                  ///< range (m); the predicted one without return
  Vector3d gradient = Vector3d::Zero();   ///< of the predicted range, over the vehicle's pose
  double stretch = 0.0;                   ///< range per metre that the wall lies off: 1 / (n . d)
  double range = 0.0;                     ///< predicted (m)
  double tau = 0.0;                       ///< time from the stamp (s)
  Vector2d normal = Vector2d::Zero();     ///< of the wall, towards the scanner
  Vector2d direction = Vector2d::Zero();  ///< of the beam (map axes)
  Vector2d hit = Vector2d::Zero();        ///< where the beam meets the wall (map axes, m)
  int beam = -1;                          ///< in the scan
  int wall = -1;
  double wall_variance = 0.0;  ///< of the residual over the walls that the beam may have met (m²)
  bool has_return = false;
  bool is_beyond =
      false;  ///< the map has another wall before this one, which the beam went through
};

/// How far off the pose and the walls may be: which of two walls that stand close a beam has met is
/// no surer than that. Without doubt it is the nearer one.
struct WallDoubt {
  Matrix3d pose_covariance = Matrix3d::Zero();
  double wall_sigma_m = 0.0;
  double distortion_ratio = 0.0;  ///< of the walls, as in `MapError`
  double noise_m = 0.0;           ///< along the beam
};

/// All beams of a scan against the map: residuals and gradients at a pose of the vehicle.
///
/// Keeps its buffers and the beams' directions: a second scan of the same fan allocates nothing.
class BeamResiduals {
 public:
  /// Takes the scan; it must stay alive while the residuals are computed. A beam that meets
  /// `missing_wall` counts as one without return.
  void set_scan(const LaserScan& scan, const ScannerModel& scanner, int missing_wall = -1);

  /// Every beam that should meet a wall no more than 2 m beyond the scan's longest return, not
  /// flatter than the options allow, in the order of the scan. `path` is the motion during the
  /// sweep, `correction` what is put on top of it. A vehicle on the move sees the map from several
  /// stations of its way. With a stride only every so many beams.
  void compute(const LineMap& map, const Pose2& map_from_vehicle, const SweepPath& path,
               const SweepCorrection& correction, const RefinementOptions& options,
               std::size_t stride = 1, const WallDoubt& doubt = {});

  std::span<const BeamResidual> beams() const { return {beams_.data(), size_}; }
  std::span<BeamResidual> beams() { return {beams_.data(), size_}; }
  /// Beams with a return where the map has nothing in range.
  int unmapped() const { return unmapped_; }
  /// Log of their density, anywhere within reach, against one over the range that was measured.
  double log_unmapped() const { return log_unmapped_; }

 private:
  struct Station {
    std::size_t begin = 0;  // beams
    std::size_t end = 0;
    double tau = 0.0;                      // of its middle (s)
    Pose2 laser;                           // at that time
    Vector2d velocity = Vector2d::Zero();  // of the laser, map axes (m/s)
    double turn_rate = 0.0;                // rad/s
  };

  Pose2 laser_at(const Pose2& map_from_vehicle, const SweepPath& path,
                 const SweepCorrection& correction, double tau) const;
  std::size_t station_count(const SweepPath& path, double spacing) const;
  /// What a beam met, and how far it went beyond that (m).
  struct Meeting {
    const WallLine* wall = nullptr;
    double residual = 0.0;  // mean over all walls that it may have met ...
    double variance = 0.0;  // ... and its spread over these (m²)
  };
  /// A beam on its way, in map axes.
  struct Beam {
    std::size_t index = 0;  // in the scan
    double tau = 0.0;
    Vector2d origin = Vector2d::Zero();
    Vector2d direction = Vector2d::Zero();
    Vector2d lever = Vector2d::Zero();  // from the vehicle to the origin
  };
  void look_from(const LineMap& map, const Station& station, const Vector2d& vehicle,
                 const RefinementOptions& options, std::size_t stride, const WallDoubt& doubt);
  void sweep_from(const LineMap& map, const Vector2d& centre, double same_place_m);
  void look_up_walls(const Station& station, std::size_t stride, std::span<int> walls) const;
  Beam beam_of(const Station& station, const RigidTransform& map_from_laser,
               const Vector2d& vehicle, std::size_t index) const;
  void count_unmapped(std::size_t beam);
  void add(const LineMap& map, const WallLine& in_the_way, const Beam& beam,
           const RefinementOptions& options, bool looks_beyond, const WallDoubt& doubt);
  Meeting meet(const WallLine& in_the_way, double measured, double range, const Beam& beam,
               const WallDoubt& doubt);

  bool find_wall_beyond(const LineMap& map, const Vector2d& end, const Vector2d& direction,
                        double reach);

  double longest_return() const;
  bool is_return(std::size_t beam) const { return limits_.is_return(scan_->ranges[beam]); }

  const LaserScan* scan_ = nullptr;
  bool has_swept_ = false;                 // since the scan was set: of this map, from here
  std::shared_ptr<const void> swept_map_;  // its identity
  Vector2d swept_from_ = Vector2d::Zero();
  double reach_ = 0.0;        // how far the map is looked at (m)
  double noise_reach_ = 0.0;  // a residual that the scanner's noise explains (m)
  ReturnLimits limits_;
  double most_secant_ = 0.0;  // of a beam that is not too flat to its wall
  int missing_wall_ = -1;
  SweepTiming timing_;
  double first_bearing_ = 0.0;
  double bearing_step_ = 0.0;
  bool evenly_spaced_ = false;  // the fan whose directions are kept
  std::vector<Vector2d> directions_;
  Visibility visibility_;
  WallNeighbours neighbours_;
  std::vector<int> near_;  // walls about the end of a beam that went through one
  WallLine beyond_;
  std::vector<Meeting> met_;  // walls that a beam may have met
  std::vector<int> walls_;
  std::vector<BeamResidual> beams_;  // the first `size_` of them
  std::size_t size_ = 0;
  int unmapped_ = 0;
  double log_unmapped_ = 0.0;
};

}  // namespace adit
