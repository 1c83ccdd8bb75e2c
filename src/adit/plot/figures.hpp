#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adit/features/features.hpp"
#include "adit/geometry/result.hpp"
#include "adit/geometry/segment.hpp"
#include "adit/map/line_map.hpp"
#include "adit/motion/odometry.hpp"
#include "adit/plot/chart.hpp"
#include "adit/plot/style.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/tracking/estimate.hpp"
#include "adit/visibility/visibility.hpp"

// The pictures of the command, and the counterparts of the paper's figures (Shaffer et al. 1992).
//
// Each function writes one file whose ending says the format (.png, .svg, .pdf) and returns an
// Error for another ending or a file that cannot be written; then nothing is left behind. Plans are
// walls in metres in the map frame. Empty inputs give pictures without the parts that they lack.
namespace adit {

/// Whether a picture can have this name: an Error for an ending that is none of the formats'.
Result<void> check_picture_name(const std::string& path);

/// The walls of a map as a plan to draw.
std::vector<Segment> plan_of(const LineMap& map);

/// A plan.
Result<void> draw_map(const std::string& path, std::span<const Segment> plan,
                      const PictureOptions& options = {});

/// What cleaning did to a plan: where walls were cut, which ends moved or went, and which are
/// loose.
Result<void> draw_map_check(const std::string& path, std::span<const Segment> raw,
                            const LineMap& cleaned, const PictureOptions& options = {});

/// A place and what it sees: intervals and features relative to it, in the map's axes.
struct ViewFromPlace {
  Vector2d position = Vector2d::Zero();
  std::vector<VisibleInterval> intervals;
  FeatureList features;
};

/// Fig. 4: the features that each place sees, one panel for each place.
Result<void> draw_visible_features(const std::string& path, std::span<const Segment> plan,
                                   std::span<const ViewFromPlace> places,
                                   const PictureOptions& options = {});

/// The corner operator at one point of the scan: the ends of its arms, and how much better two
/// lines fit than one (chi-square).
struct OperatorPosition {
  Vector2d vertex = Vector2d::Zero();
  Vector2d left_end = Vector2d::Zero();
  Vector2d right_end = Vector2d::Zero();
  double gain = 0.0;
};

/// A stretch of a scan with every position of the operator along it, in order. Responses above the
/// threshold count as corners.
struct CornerOperatorView {
  std::vector<Vector2d> points;
  std::vector<OperatorPosition> positions;
  double threshold = 25.0;
};

/// The operator with arms of `arm_m` metres at every point of the stretch that has both arms: the
/// meeting of the lines fitted to them, and what they gain over one line where the noise of a point
/// is `sigma_m`. The plain form of what extraction does incrementally, for pictures.
CornerOperatorView slide_corner_operator(std::span<const Vector2d> points, double arm_m,
                                         double sigma_m, double threshold = 25.0);

/// Fig. 5: the operator at work: a few of its positions over the points, and its response below.
/// The numbered peaks are the local maxima above the threshold, one for each operator's length.
Result<void> draw_corner_operator(const std::string& path, const CornerOperatorView& given,
                                  const PictureOptions& options = {});

/// Fig. 9: where the robot was sent and where it was estimated to be.
Result<void> draw_motion_history(const std::string& path, std::span<const Segment> plan,
                                 std::span<const Pose2> desired, std::span<const Pose2> estimated,
                                 const PictureOptions& options = {});

/// Figs. 10 and 14, and the plots of scans: the returns and the features extracted from them (may
/// be null), both of the laser's frame, carried into the map; without a pose and a plan, in the
/// laser's own axes.
struct ScanView {
  const LaserScan* scan = nullptr;
  const FeatureList* features = nullptr;
  Pose2 map_from_laser;
  std::span<const Segment> plan;
};
Result<void> draw_scan(const std::string& path, const ScanView& view,
                       const PictureOptions& options = {});

/// Model and sensed features with their pairs. The model's list is relative to the observer with
/// the map's axes (its pose has heading zero), the sensed one in the laser's frame.
struct MatchView {
  std::span<const Segment> plan;
  const FeatureList* model = nullptr;
  Pose2 map_from_model;
  const FeatureList* sensed = nullptr;
  Pose2 map_from_sensed;  ///< the estimated pose of the laser
  std::span<const FeaturePair> pairs;
};

/// Fig. 11: the predicted features; the paired ones carry the numbers of their pairs.
Result<void> draw_predicted_features(const std::string& path, const MatchView& view,
                                     const PictureOptions& options = {});

/// Fig. 12: the extracted features at the estimated pose, with the numbers of Fig. 11, in the same
/// view.
Result<void> draw_extracted_features(const std::string& path, const MatchView& view,
                                     const PictureOptions& options = {});

/// Figs. 11 and 12 in one: sensed over predicted features, each pair numbered once.
Result<void> draw_match(const std::string& path, const MatchView& view,
                        const PictureOptions& options = {});

/// Fig. 13: the surveyed path (dotted) and the estimated path (solid).
Result<void> draw_paths(const std::string& path, std::span<const Segment> plan,
                        std::span<const Pose2> surveyed, std::span<const Pose2> estimated,
                        const PictureOptions& options = {});

/// One pose of a run, and what is known of it.
struct TrajectoryPoint {
  Pose2 pose;
  std::optional<Matrix3d> covariance;  ///< over (x, y, theta) in the map frame
  std::optional<Status> status;
  std::optional<double> protection_m;  ///< infinite: no level can be given
  std::optional<double> error_m;       ///< distance from the truth, where that is known
};

/// What is drawn of a run beside its path.
struct TrajectoryOptions {
  double ellipse_sigmas = 3.0;
  double ellipse_magnification = 1.0;
  bool whole_plan = false;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("ellipse_sigmas", self.ellipse_sigmas,
          "size of the ellipses in standard deviations; 0 for none");
    field("ellipse_magnification", self.ellipse_magnification,
          "how many times larger than true the ellipses are drawn, as the legend then says");
    field("whole_plan", self.whole_plan,
          "show the whole plan even where the run covers a small part of it");
  }
};

/// A run over the plan, coloured by status, with ellipses at intervals along it; `reference`, if
/// any, dotted. Below it, where levels are given, the protection level of each pose and its error.
Result<void> draw_trajectory(const std::string& path, std::span<const Segment> plan,
                             std::span<const TrajectoryPoint> run,
                             std::span<const Pose2> reference = {},
                             const PictureOptions& options = {},
                             const TrajectoryOptions& trajectory = {});

/// Curves: errors over time, covariances.
Result<void> draw_chart(const std::string& path, const Chart& chart,
                        const PictureOptions& options = {});

}  // namespace adit
