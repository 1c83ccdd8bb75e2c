#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "adit/deskew/deskewer.hpp"
#include "adit/localizer/settings.hpp"
#include "adit/localizer/timings.hpp"
#include "adit/map/line_map.hpp"
#include "adit/motion/pose_history.hpp"
#include "adit/recovery/hypotheses.hpp"
#include "adit/recovery/place_finder.hpp"
#include "adit/recovery/search_schedule.hpp"
#include "adit/refinement/refinement.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/tracking/estimate.hpp"
#include "adit/tracking/pose_tracker.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {

/// The paper's cycle (Fig. 1): scan after scan, where the vehicle is in the map.
///
/// Deterministic: the same calls give the same bits. After the first scans it allocates nothing,
/// unless it is lost. The map must outlive the localizer.
class Localizer {
 public:
  /// With an index of the map's places a lost pose is looked for at once; without one, the first
  /// search makes it.
  Localizer(const LineMap& map, const LocalizerSettings& settings,
            std::shared_ptr<const PlaceIndex> places = nullptr);
  Localizer(LineMap&& map, const LocalizerSettings& settings,
            std::shared_ptr<const PlaceIndex> places = nullptr) = delete;
  Localizer(const Localizer&) = delete;  // estimates view its buffers
  Localizer& operator=(const Localizer&) = delete;
  ~Localizer() = default;

  /// Says where the vehicle is at the next scan, and how surely (default: the start sigmas).
  /// Forgets all else, what was fed as well. A start that is not finite is ignored.
  void start(const Pose2& map_from_vehicle,
             const std::optional<Matrix3d>& covariance = std::nullopt);

  /// The vehicle may be anywhere in the mine: the next scan is looked for in all of it. `lost`
  /// until something is found, `ambiguous` while several poses explain the scans. Needs all points
  /// (`full` or `points`) and `[recovery] searches`.
  void start_anywhere();

  /// Feeds dead reckoning: stamped poses in the odometry's frame, of which only differences count.
  void add_odometry(const StampedPose& odom_from_vehicle);

  /// Feeds a gyro's heading (rad) at a stamp; its differences replace the odometry's rotation.
  void add_gyro(double stamp, double heading);

  /// One turn of the cycle, with dead reckoning taken from what was fed, at the scan's stamp; with
  /// none near it the pose becomes unsure with the time since the last scan, and a pose that a scan
  /// has contradicted is not trusted again, for nobody knows the way.
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
  const ScanFit& scan_fit() const { return scan_fit_; }
  const Refiner& refiner() const { return refiner_; }
  const MapError& map_error() const { return map_error_.error(); }
  /// The poses of which any may be the true one; none unless the pose was lost.
  const Hypotheses& hypotheses() const { return hypotheses_; }
  const StampCounts& stamp_counts() const { return stamps_.counts(); }
  const Visibility& visibility() const { return visibility_; }
  const Extractor& extractor() const { return extractor_; }
  const Timings& timings() const { return timings_; }

 private:
  // The page: localizer.cpp.
  const Estimate& turn(const LaserScan& scan, const std::optional<Pose2>& odom_from_vehicle);
  static bool is_usable(const LaserScan& scan);
  const Estimate& skip(double stamp);
  bool is_repeated(const LaserScan& scan, const std::optional<Pose2>& odom_from_vehicle);
  void find_by_features();

  // The stages: stages.cpp, all_points.cpp for `refine_pose`, and elsewhere.cpp for hypotheses.
  void begin_turn();
  void predict_pose(double stamp, const std::optional<Pose2>& odom_from_vehicle);
  void deskew_scan(const LaserScan& scan);
  SweepPath sweep_path(const SweepMotion& motion, const LaserScan& scan) const;
  void dead_reckon_by(const Pose2& move, const OdometryNoise& noise);
  void wait(bool knows_turn);
  bool wants_features() const;
  void predict_features();
  void extract_features();
  void match_features();
  void estimate_pose();
  void refine_pose(const LaserScan& scan);
  void weigh_hypotheses(const LaserScan& scan);
  void seek_elsewhere(const LaserScan& scan);
  void track_pose();
  void learn_map_error();
  void judge(double stamp);
  double protection_radius();

  bool uses_points() const { return settings_.estimator != Estimator::features; }
  bool features_are_believable() const;
  PoseWithCovariance vehicle_by_features() const;
  const ScanFit& refine_from(const RefinementInput& input, const PoseWithCovariance& start);
  PoseWithCovariance loose(const PoseWithCovariance& prediction) const;
  void add_rival(const ScanFit& fit, double lead);
  ScanFit refine_rival(const RefinementInput& input);
  bool has_lost_direction(const ScanFit& fit) const;
  bool is_poor(const ScanFit& fit) const;
  void search(const RefinementInput& input, const PoseWithCovariance& first);
  bool reconciled() const;
  void change_places(const RefinementInput& input);
  void weigh_rival(const RefinementInput& input, const ScanFit& rival_fit);
  void forget();
  RelocationQuery query_for(const LaserScan& scan) const;
  PlaceFinderOptions finder_options() const;
  bool is_doubtful() const;
  bool doubts(const RelocationResult& found) const;
  void take_search();
  void believe(bool is_own);
  void give_up();
  void follow(const Hypotheses::Hypothesis& hypothesis, const RefinementInput& input);
  Matrix3d floored(const Matrix3d& covariance) const;
  Matrix3d shared_map_error() const;

  /// Another pose that may be the true one, carried along until the scans have decided.
  struct Rival {
    PoseTracker tracker;
    double lead = 0.0;   ///< of the estimate over the rival, log of the odds
    double way_m = 0.0;  ///< since they parted
  };

  const LineMap& map_;
  LocalizerSettings settings_;
  PoseHistory odometry_;
  PoseHistory gyro_;
  StampWatch stamps_;
  MapErrorEstimator map_error_;
  FirstMapError first_map_error_;
  PoseTracker tracker_;

  // Of the last scan.
  std::optional<Pose2> last_odometry_;
  std::optional<double> last_gyro_;
  Pose2 vehicle_from_laser_;
  Trust trust_;
  bool clear_ = true;     // the map explained nearly all of it
  bool doubled_ = false;  // the plan has walls twice there
  double way_m_ = 0.0;    // since the last scan, by dead reckoning
  std::optional<Rival> rival_;
  Protection protection_;
  RecentDisplacement displacement_;

  // While the pose is lost.
  PlaceFinder finder_;
  SearchSchedule schedule_;
  SearchSchedule doubts_;  // of poses that are trusted
  bool is_doubt_ = false;  // the search under way is for one of them
  double doubted_ = 0.0;   // what that pose explained of the scan that is looked for
  Hypotheses hypotheses_;
  PoseTracker since_search_;   // dead reckoning from where the scan that is looked for was taken
  double trusted_m_ = 0.0;     // way since the pose was found
  bool is_confirmed_ = false;  // a second search found no other pose
  bool is_anywhere_ = false;   // nothing is known of the pose
  bool is_found_ = true;       // some pose was stated or believed since the start

  // Of this turn.
  PoseWithCovariance predicted_;
  PoseWithCovariance predicted_laser_;
  std::optional<SweepPrior> motion_;
  const LaserScan* still_ = nullptr;  // the scan as taken at its stamp
  ScannerModel scanner_;
  bool uses_features_ = false;
  bool believed_ = false;
  bool contributed_ = false;  // the scan corrected dead reckoning
  bool jumped_ = false;       // the clock, before this scan
  bool ambiguous_ = false;

  Deskewer deskewer_;
  LaserScan deskewed_;
  Visibility visibility_;
  Extractor extractor_;
  Matcher matcher_;
  FeatureEstimator estimator_;
  Refiner refiner_;
  FeatureList model_;
  FeatureList model_in_laser_;
  MatchResult match_;
  FeatureFit fit_;
  ScanFit scan_fit_;
  std::vector<WallEvidence> walls_;
  Timings timings_;
  Estimate estimate_;
};

}  // namespace adit
