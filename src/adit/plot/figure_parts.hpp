#pragma once

#include <span>
#include <string>
#include <vector>

#include "adit/features/features.hpp"
#include "adit/geometry/segment.hpp"
#include "adit/map/box.hpp"
#include "adit/plot/canvas.hpp"
#include "adit/plot/sheet.hpp"
#include "adit/scan/laser_scan.hpp"

// What several figures draw alike.
namespace adit {

inline constexpr MarkStyle kRobotMark{MarkShape::cross, 7.0, kRobotColour};

/// The smallest box around the walls; empty without any.
Box box_around(std::span<const Segment> plan);

/// Walls thin enough that those in the view do not run together; an empty view is the whole plan.
Stroke wall_stroke(std::span<const Segment> plan, const Box& view, const Colour& colour);

/// `focus` with room around it, or the whole plan where the focus covers much of it anyway.
Box focused_view(std::span<const Segment> plan, const Box& focus);

/// How one list of features is drawn.
struct FeatureStyle {
  Colour colour = kSensedColour;
  double line_width = 1.6;
  double corner_size = 4.2;  ///< points
  bool bisectors = true;
};

/// Lines, then corners: occluding ones as rings, the others as dots, with a tick along the
/// bisector. Only the features whose entry in `keep` is true; all if it is empty.
struct FeatureSelection {
  std::vector<char> lines;
  std::vector<char> corners;
};
void add_features(Canvas& canvas, const FeatureList& features, const Pose2& map_from_features,
                  const FeatureStyle& style, const FeatureSelection& keep = {});

/// Where a feature's number stands.
Vector2d place_of(const FeatureList& features, FeatureKind kind, int index);

/// Explains the marks of add_features.
void explain_features(Sheet& sheet, const FeatureStyle& style, const std::string& of);

/// The ends and vertices of the features, in the map.
Box box_around(const FeatureList& features, const Pose2& map_from_features);

/// The places of the poses, of those that are finite.
Box box_around(std::span<const Pose2> poses);

/// The smallest box that holds both.
Box joined(Box a, const Box& b);

/// Where the beams of a scan met something, in the map.
std::vector<Vector2d> returns_of(const LaserScan& scan, const Pose2& map_from_laser);

/// How so many of them are drawn.
MarkStyle range_point_style(std::size_t count);

std::vector<Vector2d> translations(std::span<const Pose2> poses);

}  // namespace adit
