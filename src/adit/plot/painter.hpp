#pragma once

#include <cairo.h>

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "adit/geometry/result.hpp"
#include "adit/plot/page_path.hpp"
#include "adit/plot/style.hpp"

namespace adit {

enum class PictureFormat { png, svg, pdf };

/// The format that a file's ending names, in either case of letters; an Error for any other.
Result<PictureFormat> picture_format(const std::string& path);

/// Where a text lies about its place: -1 left of or above it, 0 centred, 1 right of or below it.
struct TextAnchor {
  int horizontal = 0;
  int vertical = 0;
};

/// One page of a PNG, SVG or PDF, in points (1/72 inch) from its upper left corner.
///
/// Only this room's sources include this header: it is the one place that knows cairo. The same
/// calls give the same bytes.
class Painter {
 public:
  Painter(PictureFormat format, const Vector2d& size, double dots_per_inch);

  void stroke(const PathPoints& path, const Stroke& style);
  void line(const Vector2d& a, const Vector2d& b, const Stroke& style);
  void polygon(std::span<const Vector2d> corners, const std::optional<Colour>& fill,
               const std::optional<Stroke>& outline);
  void mark(const Vector2d& at, const MarkStyle& style);
  /// `angle` is counter-clockwise as the reader sees it.
  void arrow(const Vector2d& tail, double angle, const ArrowStyle& style);
  void text(const Vector2d& at, const std::string& words, const TextStyle& style,
            const TextAnchor& anchor);
  /// Written upwards, centred.
  void text_upwards(const Vector2d& at, const std::string& words, const TextStyle& style);
  /// Width of the words and height of a line of capitals.
  Vector2d text_size(const std::string& words, const TextStyle& style);

  void push_clip(const PageRect& rect);
  void pop_clip();

  /// The bytes of the file.
  Result<std::string> finish();

 private:
  struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  void set_stroke(const Stroke& style);
  void set_colour(const Colour& colour);
  void set_font(const TextStyle& style);
  void head(const Vector2d& tip, const Vector2d& along, const ArrowStyle& style);

  PictureFormat format_;
  std::unique_ptr<std::string> bytes_;  // its address is cairo's, and outlives the surface
  std::unique_ptr<cairo_surface_t, Destroy> surface_;
  std::unique_ptr<cairo_t, Destroy> cairo_;
};

}  // namespace adit
