#pragma once

#include <array>
#include <optional>
#include <vector>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// A straight piece of wall as the scanner meets it, counter-clockwise from `begin` to `end`.
///
/// In the frame of the observer, who stands to the left of begin -> end. `orientation` is the angle
/// of the normal that points away from the observer; `distance` is the perpendicular distance of
/// the wall along that normal, so every point p of it has p . (cos, sin)(orientation) = distance.
/// It is never negative by more than noise. (The paper's length, perpendicular distance,
/// orientation.)
struct Line {
  Vector2d begin = Vector2d::Zero();
  Vector2d end = Vector2d::Zero();
  double orientation = 0.0;
  double distance = 0.0;
  Matrix2d covariance = Matrix2d::Zero();  ///< over (orientation, distance); zero for model lines
  int points = 0;                          ///< range points behind it; 0 for model lines
  int segment = -1;                        ///< index in the map; -1 for sensed lines

  double length() const { return (end - begin).norm(); }
};

/// Where a visible wall ends: at another visible wall, or before a gap behind which the view goes
/// on.
///
/// `arms` are indices into the list's lines: [0] the line met before the vertex, [1] the one met
/// after it, counter-clockwise; -1 where that arm is not visible. A corner with both arms has the
/// paper's concave angle (the smaller angle between the arms, in (0, pi]) and the orientation of
/// its bisector (pointing from the vertex into that angle). With one arm, both are absent from a
/// sensed corner; a model corner has them where the map knows the other wall.
struct Corner {
  Vector2d position = Vector2d::Zero();
  Matrix2d covariance = Matrix2d::Zero();  ///< of the position (m²); zero for model corners
  std::optional<double> concave_angle;
  std::optional<double> bisector;
  double concave_angle_sigma = 0.0;  ///< rad
  double bisector_sigma = 0.0;       ///< rad
  bool occluding = false;            ///< its wall hides part of what lies behind
  std::array<int, 2> arms{-1, -1};
  int points = 0;   ///< range points behind it; 0 for model corners
  int vertex = -1;  ///< index in the map; -1 for sensed corners
};

enum class FeatureKind { corner, line };

/// One entry of the counter-clockwise order: which feature, and the azimuth (rad) that sorts it (a
/// corner's own, the middle of a line).
struct FeatureRef {
  FeatureKind kind = FeatureKind::corner;
  int index = 0;
  double azimuth = 0.0;
};

/// What prediction and extraction share: two arrays and the order in which the scanner meets them,
/// by azimuth in (-pi, pi]. Positions are relative to the observer's frame.
struct FeatureList {
  std::vector<Corner> corners;
  std::vector<Line> lines;
  std::vector<FeatureRef> order;

  void clear() {
    corners.clear();
    lines.clear();
    order.clear();
  }
  std::size_t size() const { return corners.size() + lines.size(); }
};

/// A sensed feature and the model feature that it is taken for, both by index in their lists.
struct FeaturePair {
  FeatureKind kind = FeatureKind::corner;
  int sensed = 0;
  int model = 0;

  bool operator==(const FeaturePair&) const = default;
};

/// Rebuilds `order` from the corners and lines.
void sort_counter_clockwise(FeatureList& features);

/// The list seen from another frame: b_from_a carries positions, orientations and covariances.
/// Distances and orientations of lines keep their outward normal. `out` is reused.
void transform(const FeatureList& features, const Pose2& b_from_a, FeatureList& out);

/// The line in another frame.
Line transform(const Line& line, const Pose2& b_from_a);

/// The corner in another frame.
Corner transform(const Corner& corner, const Pose2& b_from_a);

}  // namespace adit
