#pragma once

#include <span>
#include <string>

#include "adit/geometry/pose2.hpp"
#include "adit/geometry/result.hpp"
#include "adit/geometry/segment.hpp"
#include "adit/plot/style.hpp"
#include "adit/scan/laser_scan.hpp"

// Pictures of a search in the whole mine. As in figures.hpp, each function writes one file.
namespace adit {

/// A pose of the vehicle that may be the true one, and how much speaks for it.
struct WeightedPose {
  Pose2 pose;                              ///< map_from_vehicle
  Matrix3d covariance = Matrix3d::Zero();  ///< over (x, y, theta) in the map frame
  double weight = 0.0;                     ///< of all, summing to one
};

/// What a search has found, the best pose first, and the scan that was sought (may be null).
struct RankedPosesView {
  std::span<const Segment> plan;
  std::span<const WeightedPose> poses;
  const LaserScan* scan = nullptr;
};

/// The ranked poses over the plan, larger the more they weigh, with ellipses of three standard
/// deviations, and the scan as it lies at the best.
Result<void> draw_ranked_poses(const std::string& path, const RankedPosesView& view,
                               const PictureOptions& options = {});

/// How a search answers a scan that was taken at a known place.
enum class PlaceAnswer {
  unique,     ///< one pose, the right one
  open,       ///< one place, but a direction of it is open
  ambiguous,  ///< several poses, or one that is not sure
  lost,       ///< none
  wrong,      ///< one pose, and not the right one
};
inline constexpr std::size_t kPlaceAnswers = 5;

/// "one answer", "a direction open", "ambiguous", "lost", "wrong".
const char* to_string(PlaceAnswer answer);

/// A place, how a scan taken there is answered, and how many poses explain it.
struct SurveyedPlace {
  Vector2d position = Vector2d::Zero();
  PlaceAnswer answer = PlaceAnswer::unique;
  int poses = 1;
};

/// A place and another from which the scan looks the same.
struct AliasLink {
  Vector2d place = Vector2d::Zero();
  Vector2d alias = Vector2d::Zero();
  double weight = 0.0;  ///< of the alias among all that explain the scan
};

/// Where in a plan one scan tells the place and where others look the same; these are linked.
Result<void> draw_aliases(const std::string& path, std::span<const Segment> plan,
                          std::span<const SurveyedPlace> places, std::span<const AliasLink> links,
                          const PictureOptions& options = {});

}  // namespace adit
