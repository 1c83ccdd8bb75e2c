#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/map/line_map.hpp"
#include "adit/refinement/beam_residuals.hpp"
#include "adit/refinement/classification.hpp"
#include "adit/refinement/map_error.hpp"
#include "adit/refinement/options.hpp"
#include "adit/refinement/whitening.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// The motion during a sweep as dead reckoning has it.
struct SweepPrior {
  SweepPath path;
  Matrix3d covariance = Matrix3d::Zero();  ///< of its mean (vx, vy, omega)
};

/// A scan, and what it is compared with.
struct RefinementInput {
  const LineMap& map;
  const LaserScan& scan;
  const ScannerModel& scanner;
  const MapError& map_error;
  std::optional<SweepPrior> motion;  ///< of a scanner that takes its time
  int missing_wall = -1;             ///< beams on this one count as if nothing had come back
};

/// What one wall of the plan contributed to a fit over N parameters.
template <int N>
struct WallShareOf {
  int wall = -1;
  NormalEquations<N> equations;
};
using WallShare = WallShareOf<3>;

/// All points of a scan against the map: what they say of the vehicle's pose.
///
/// The log likelihood near `pose` is score^T d - d^T information d / 2 for a pose that lies d (x,
/// y, theta; map frame) away. Directions that the scan does not show have no information.
struct ScanFit {
  Pose2 pose;  ///< of scan and prior, most likely; where not converged, the last that was tried
  Matrix3d information = Matrix3d::Zero();
  Vector3d score = Vector3d::Zero();
  /// The information if the offsets of the walls were known: what the noise alone leaves open.
  Matrix3d white_information = Matrix3d::Zero();
  SweepCorrection correction;  ///< of the sweep's motion, on top of dead reckoning's
  double chi_square = 0.0;
  BeamCounts counts;
  double log_evidence = 0.0;           ///< against "something else" everywhere
  double log_likelihood = 0.0;         ///< against what no pose changes: compares poses
  double expected_log_evidence = 0.0;  ///< if all returns came from the map's walls
  int iterations = 0;
  bool converged = false;
};

/// The paper's iconic estimator: a maximum-likelihood fit of all points to the map.
///
/// Residuals lie along the beams, where the scanner's noise is; each step looks at the map anew
/// from where it stands (section V of the paper names this as the estimator to come; the bound that
/// it reaches is Censi's, 2007). Deterministic; allocates nothing once its buffers have grown.
class Refiner {
 public:
  /// Fits from `start`, whose covariance says how far off it may be. `prior` holds what the scan
  /// leaves open; the fit's information does not contain it.
  const ScanFit& refine(const RefinementInput& input, const PoseWithCovariance& prior,
                        const PoseWithCovariance& start, const RefinementOptions& options);

  /// The pose, of those given, at which scan and prior are most likely if it is off by `spread`.
  /// Looks at a hundred beams or so.
  Pose2 most_likely(const RefinementInput& input, const PoseWithCovariance& prior,
                    std::span<const Pose2> poses, const Matrix3d& spread,
                    const RefinementOptions& options);

  /// The beams of the last step, their residuals carried to the fit's pose, and the probability of
  /// each to have met the map's wall.
  std::span<const BeamResidual> beams() const { return residuals_.beams(); }
  std::span<const double> on_wall() const { return classifier_.on_wall(); }
  /// The walls that gainsay the last fit most, the worst first and no more than so many: those that
  /// more than a few returns should have met and did not.
  std::span<const int> worst_walls(std::size_t most);
  /// The parts of the fit's information, wall by wall, over the pose. On the move what they leave
  /// open of the sweep's motion is taken out of each, and dead reckoning's part in that is no
  /// wall's.
  const std::vector<WallShare>& shares() const { return shares_; }

 private:
  void weigh(const RefinementInput& input, const Matrix3d& spread,
             const RefinementOptions& options);
  template <int N>
  void accumulate(const MapError& map_error, std::vector<WallShareOf<N>>& shares,
                  NormalEquations<N>& shared);
  template <int N>
  NormalEquations<N> white_equations() const;
  void combine_standing(const MapError& map_error);
  void combine_moving(const MapError& map_error, const SweepPrior& motion);
  void take(const NormalEquations<3>& shared);
  Matrix3d white_information(const RefinementInput& input) const;
  void take_last_step(bool moving);
  template <int N>
  double shift_beams(const Eigen::Matrix<double, N, 1>& move);
  double step(const PoseWithCovariance& prior, bool moving, const RefinementOptions& options,
              Matrix3d& spread);
  double log_likelihood(const RefinementOptions& options) const;
  void count_beams();
  double count_between() const;
  bool is_smooth(double length, const RefinementOptions& options) const;
  bool is_last(double length, const RefinementOptions& options);

  BeamResiduals residuals_;
  BeamClassifier classifier_;
  std::vector<std::pair<int, double>> off_wall_;  // beams, wall by wall
  std::vector<int> worst_walls_;
  std::vector<double> noise_;   // variance that a beam shares with no other (m²)
  std::vector<double> offset_;  // change of its range per sigma of the wall's offset (m)
  std::vector<double> spread_;  // variance of a residual; corners count as sharp (m²)
  double last_share_ = 0.0;
  double spread_share_ = 0.0;  // of the doubt about the pose in that, on average
  std::vector<WallShare> shares_;
  std::vector<WallShareOf<9>> moving_shares_;  // with the correction of the sweep's motion
  Pose2 next_;
  SweepCorrection next_correction_;
  // The correction's rows of the normal equations.
  Eigen::Matrix<double, 6, 9> correction_information_;
  Eigen::Matrix<double, 6, 1> correction_score_;
  ScanFit fit_;
};

}  // namespace adit
