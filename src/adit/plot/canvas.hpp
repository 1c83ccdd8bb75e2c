#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/geometry/segment.hpp"
#include "adit/map/box.hpp"
#include "adit/plot/page_path.hpp"
#include "adit/plot/style.hpp"

namespace adit {

class Painter;

/// The part of a picture that shows the plane: layers in metres, drawn in the order in which they
/// were added, labels last.
///
/// Equal scale in x and y, y up. Coordinates that are not finite are left out. Sizes in points
/// stand on the page whatever the scale.
class Canvas {
 public:
  void segments(std::span<const Segment> segments, const Stroke& style);
  void polyline(std::span<const Vector2d> points, const Stroke& style);
  void marks(std::span<const Vector2d> places, const MarkStyle& style);
  void mark(const Vector2d& place, const MarkStyle& style) { marks({&place, 1}, style); }
  /// Tails at the poses, pointing along their headings.
  void arrows(std::span<const Pose2> poses, const ArrowStyle& style);
  /// A filled shape; areas do not widen the automatic view.
  void area(std::span<const Vector2d> corners, const std::optional<Colour>& fill,
            const std::optional<Stroke>& outline);
  /// The ellipse of `sigmas` standard deviations of a position (m²); none where the covariance is
  /// not finite or not positive semidefinite.
  void ellipse(const Vector2d& center, const Matrix2d& covariance, double sigmas,
               const std::optional<Colour>& fill, const std::optional<Stroke>& outline);
  /// The fan from bearing `from` counter-clockwise to `to` (rad), `radius` metres long.
  void sector(const Vector2d& center, double radius, double from, double to, const Colour& fill);
  /// Words near a place, at least `clearance` points away from it, where little else is drawn.
  void label(const Vector2d& place, std::string words, const TextStyle& style = kNumberText,
             double clearance = 3.0);

  /// Shows this part of the plane; without it everything that was added.
  void show(const Box& view) { view_ = view; }
  void caption(std::string words) { caption_ = std::move(words); }
  const std::string& caption() const { return caption_; }

  /// What is shown: the part asked for, or everything with a margin; never empty or a sliver.
  Box view() const;
  /// Everything that was added, but for areas; empty when nothing was.
  const Box& content() const { return content_; }

  /// Points per metre where the plane is drawn into this rectangle.
  double scale_in(const PageRect& area) const;
  /// Draws the layers into a rectangle of the page.
  void draw(Painter& painter, const PageRect& area, bool axes) const;

 private:
  struct PathLayer {
    PathPoints path;
    Stroke style;
  };
  struct MarkLayer {
    std::vector<Vector2d> places;
    MarkStyle style;
  };
  struct ArrowLayer {
    std::vector<Pose2> poses;
    ArrowStyle style;
  };
  struct AreaLayer {
    std::vector<Vector2d> corners;
    std::optional<Colour> fill;
    std::optional<Stroke> outline;
  };
  struct Label {
    Vector2d place;
    std::string words;
    TextStyle style;
    double clearance = 0.0;
  };
  using Layer = std::variant<PathLayer, MarkLayer, ArrowLayer, AreaLayer>;
  class Renderer;

  void extend(const Vector2d& point);

  std::vector<Layer> layers_;
  std::vector<Label> labels_;
  Box content_;
  std::optional<Box> view_;
  std::string caption_;
};

}  // namespace adit
