#pragma once

#include <optional>
#include <string>

namespace adit {

/// Red, green, blue and opacity, each from 0 to 1.
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;
};

/// The same colour at another opacity.
constexpr Colour faded(const Colour& colour, double alpha) {
  return {colour.red, colour.green, colour.blue, alpha};
}

// Hues that colour-blind readers tell apart and that stay distinct in grey print: Okabe & Ito 2008.
inline constexpr Colour kInk{0.10, 0.10, 0.12};
inline constexpr Colour kGrey{0.55, 0.55, 0.58};
inline constexpr Colour kPaleGrey{0.78, 0.78, 0.80};
inline constexpr Colour kWhite{1.0, 1.0, 1.0};
inline constexpr Colour kBlue{0.000, 0.447, 0.698};
inline constexpr Colour kSkyBlue{0.337, 0.706, 0.914};
inline constexpr Colour kGreen{0.000, 0.620, 0.451};
inline constexpr Colour kOrange{0.902, 0.624, 0.000};
inline constexpr Colour kVermilion{0.835, 0.369, 0.000};
inline constexpr Colour kPurple{0.800, 0.475, 0.655};

// What each thing is drawn in, the same in every picture.
inline constexpr Colour kWallColour = kInk;
inline constexpr Colour kPlanColour{0.66, 0.66, 0.69};  // a plan behind something else
inline constexpr Colour kModelColour = kBlue;
inline constexpr Colour kSensedColour = kVermilion;
inline constexpr Colour kScanColour{0.48, 0.48, 0.51};
inline constexpr Colour kRobotColour = kInk;

enum class Dash { solid, dashed, dotted };

/// How a line is drawn; widths in points (1/72 inch).
struct Stroke {
  Colour colour = kInk;
  double width = 0.7;
  Dash dash = Dash::solid;
};

enum class MarkShape { dot, ring, cross, plus, square, diamond };

/// How a single place is drawn; `size` is the diameter in points.
struct MarkStyle {
  MarkShape shape = MarkShape::dot;
  double size = 3.0;
  Colour colour = kInk;
};

enum class ArrowHead { none, open, filled };

/// How a pose or direction is drawn: an arrow of a fixed size on the page, its tail at the place.
struct ArrowStyle {
  ArrowHead head = ArrowHead::filled;
  double length = 13.0;  ///< points
  double width = 0.8;    ///< points
  Colour colour = kInk;
};

/// How words are written; `size` in points.
struct TextStyle {
  double size = 7.0;
  bool bold = false;
  Colour colour = kInk;
};

inline constexpr TextStyle kTitleText{9.0, true, kInk};
inline constexpr TextStyle kCaptionText{8.0, true, kInk};
inline constexpr TextStyle kLegendText{7.5, false, kInk};
inline constexpr TextStyle kAxisText{7.0, false, kInk};
inline constexpr TextStyle kNumberText{6.5, false, kInk};

/// One line of the legend: samples of what is meant, and its name.
struct LegendEntry {
  std::string text;
  std::optional<Stroke> line;
  std::optional<MarkStyle> mark;
  std::optional<ArrowStyle> arrow;
  std::optional<Colour> area;
};

/// Size and dress of a picture.
struct PictureOptions {
  double width_mm = 120.0;
  double max_height_mm = 150.0;
  double dots_per_inch = 220.0;
  bool axes = false;
  bool scale_bar = true;
  bool legend = true;
  std::string title;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("width_mm", self.width_mm,
          "width of the page (mm); a journal's one and a half columns by default");
    field("max_height_mm", self.max_height_mm,
          "a picture that would become higher is scaled down (mm); the legend comes on top");
    field("dots_per_inch", self.dots_per_inch, "resolution of PNG files");
    field("axes", self.axes, "draw a frame with coordinates in metres around plans");
    field("scale_bar", self.scale_bar, "draw a scale bar below plans");
    field("legend", self.legend, "name what is drawn below the picture");
    field("title", self.title, "a line above the picture; empty for none");
  }
};

}  // namespace adit
