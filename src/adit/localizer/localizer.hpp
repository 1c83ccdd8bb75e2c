#pragma once

#include <optional>

#include "adit/estimation/estimation.hpp"
#include "adit/extraction/extraction.hpp"
#include "adit/localizer/timings.hpp"
#include "adit/map/line_map.hpp"
#include "adit/matching/matching.hpp"
#include "adit/motion/odometry.hpp"
#include "adit/motion/pose_history.hpp"
#include "adit/prediction/prediction.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/tracking/estimate.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {

/// When an estimate is believed, and what is believed before the first one.
struct LocalizerOptions {
  double start_sigma_m = 0.25;
  double start_sigma_rad = 0.07;
  double gyro_sigma_rad = 0.002;
  double max_age_s = 0.5;
  double prior_floor_m = 0.02;
  double prior_floor_rad = 0.004;
  double gate_chi_square = 60.0;
  double few_pairs_gate_chi_square = 16.3;
  int few_pairs = 4;
  double map_stretch_m = 2.0;
  int min_pairs = 2;
  double max_dropped_ratio = 0.5;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("start_sigma_m", self.start_sigma_m, "sigma of the start's x and y (m)");
    field("start_sigma_rad", self.start_sigma_rad, "sigma of the start's heading (rad); 4 degrees");
    field(
        "gyro_sigma_rad", self.gyro_sigma_rad,
        "sigma of the turn between two scans by the gyro (rad); the paper's steps of 0.25 degrees");
    field("max_age_s", self.max_age_s,
          "odometry or gyro fed longer before or after the scan than this is not used for it (s)");
    field(
        "prior_floor_m", self.prior_floor_m,
        "the predicted pose counts as no surer than this (m): the map's errors that one scan sees "
        "are seen again by the next");
    field("prior_floor_rad", self.prior_floor_rad, "the same for the heading (rad)");
    field("gate_chi_square", self.gate_chi_square,
          "a fit farther than this from the predicted pose is refused; far beyond chance (7.3 "
          "sigma), "
          "because wheels slip more than their noise says");
    field("few_pairs_gate_chi_square", self.few_pairs_gate_chi_square,
          "the same for a fit of few pairs, which must not overrule dead reckoning; chi-square of "
          "three degrees of freedom at 1e-3");
    field("few_pairs", self.few_pairs, "a fit of fewer pairs than this has few");
    field(
        "map_stretch_m", self.map_stretch_m,
        "length of wall that shares one error of the plan (m): as far as that, the plan turns the "
        "heading");
    field("min_pairs", self.min_pairs, "a fit of fewer pairs is refused");
    field("max_dropped_ratio", self.max_dropped_ratio,
          "a fit that had to drop a larger part of its pairs is refused");
  }
};

/// Everything that the cycle needs to know beside the map.
struct LocalizerSettings {
  ScannerModel scanner;
  OdometryNoise odometry;
  PredictionOptions prediction;
  ExtractionOptions extraction;
  MatchingOptions matching;
  EstimationOptions estimation;
  LocalizerOptions localizer;
};

/// The paper's cycle (Fig. 1): scan after scan, where the vehicle is in the map.
///
/// Deterministic: the same calls give the same bits. After the first scans it allocates nothing.
/// The map must outlive the localizer.
class Localizer {
 public:
  Localizer(const LineMap& map, const LocalizerSettings& settings);
  Localizer(LineMap&& map, const LocalizerSettings& settings) = delete;
  Localizer(const Localizer&) = delete;  // estimates view its buffers
  Localizer& operator=(const Localizer&) = delete;
  ~Localizer() = default;

  /// Says where the vehicle is at the next scan, and how surely (default: the start sigmas).
  void start(const Pose2& map_from_vehicle,
             const std::optional<Matrix3d>& covariance = std::nullopt);

  /// Feeds dead reckoning: stamped poses in the odometry's frame, of which only differences count.
  void add_odometry(const StampedPose& odom_from_vehicle);

  /// Feeds a gyro's heading (rad) at a stamp; its differences replace the odometry's rotation.
  void add_gyro(double stamp, double heading);

  /// One turn of the cycle, with dead reckoning taken from what was fed, at the scan's stamp; with
  /// none near it the vehicle is taken to have stood still.
  const Estimate& update(const LaserScan& scan);

  /// One turn of the cycle, with the odometry pose that came with the scan. A pose or a mounting
  /// that is not finite makes the scan unusable: it is answered `lost`, and the next one as ever.
  const Estimate& update(const LaserScan& scan, const Pose2& odom_from_vehicle);

  const Estimate& estimate() const { return estimate_; }

  /// What the last turn worked with, for pictures and tests. Model features are relative to the
  /// predicted position of the laser, in the map's axes; sensed ones are in the laser's frame.
  const PoseWithCovariance& predicted() const { return predicted_; }
  const FeatureList& model_features() const { return model_; }
  const FeatureList& sensed_features() const { return extractor_.features(); }
  const MatchResult& match() const { return match_; }
  const FeatureFit& fit() const { return fit_; }
  const Visibility& visibility() const { return visibility_; }
  const Extractor& extractor() const { return extractor_; }
  const Timings& timings() const { return timings_; }

 private:
  const Estimate& turn(const LaserScan& scan, const std::optional<Pose2>& odom_from_vehicle);
  const Estimate& skip(double stamp);
  void predict_pose(double stamp, const std::optional<Pose2>& odom_from_vehicle);
  void predict_features(const LaserScan& scan);
  void extract_features(const LaserScan& scan);
  void match_features();
  void estimate_pose();
  void judge(double stamp);
  bool is_believable() const;
  Matrix3d floored(const Matrix3d& covariance) const;
  Matrix3d shared_map_error() const;

  const LineMap& map_;
  LocalizerSettings settings_;
  PoseHistory odometry_;
  PoseHistory gyro_;

  PoseWithCovariance last_;
  std::optional<Pose2> last_odometry_;
  std::optional<double> last_gyro_;
  PoseWithCovariance predicted_;
  Pose2 vehicle_from_laser_;
  PoseWithCovariance predicted_laser_;

  Visibility visibility_;
  Extractor extractor_;
  Matcher matcher_;
  FeatureEstimator estimator_;
  FeatureList model_;
  FeatureList model_in_laser_;
  MatchResult match_;
  FeatureFit fit_;
  Timings timings_;
  Estimate estimate_;
};

}  // namespace adit
