#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "adit/plot/figure_parts.hpp"
#include "adit/plot/figures.hpp"
#include "adit/plot/place_figures.hpp"

namespace adit {
namespace {

constexpr Colour kLinkColour = kPurple;

/// The places that are drawn alike.
struct PlaceKind {
  PlaceAnswer answer;
  int fewest = 0;  // poses
  int most = 0;
  MarkShape shape;
  double size;  // points; of a picture of few places
  Colour colour;
  const char* name;
};

constexpr int kAny = 1000000;
constexpr Colour kFew{0.800, 0.475, 0.655};   // two or three poses
constexpr Colour kMany{0.480, 0.090, 0.380};  // more: darker

// The worse the answer, the later and the larger it is drawn.
constexpr std::array<PlaceKind, 7> kKinds{{
    {PlaceAnswer::unique, 0, kAny, MarkShape::dot, 2.6, kBlue, "one answer"},
    {PlaceAnswer::open, 0, kAny, MarkShape::diamond, 3.2, kOrange, "a direction open"},
    {PlaceAnswer::ambiguous, 0, 1, MarkShape::square, 3.0, kSkyBlue, "not sure"},
    {PlaceAnswer::ambiguous, 2, 3, MarkShape::square, 3.4, kFew, "2 or 3 poses"},
    {PlaceAnswer::ambiguous, 4, kAny, MarkShape::square, 3.8, kMany, "4 poses or more"},
    {PlaceAnswer::lost, 0, kAny, MarkShape::cross, 4.0, kVermilion, "lost"},
    {PlaceAnswer::wrong, 0, kAny, MarkShape::cross, 6.0, kInk, "wrong"},
}};

bool is_of(const SurveyedPlace& place, const PlaceKind& kind) {
  return place.answer == kind.answer && place.poses >= kind.fewest && place.poses <= kind.most;
}

/// The links of much weight darker than those of little.
void add_links(Canvas& canvas, std::span<const AliasLink> links) {
  constexpr std::array<double, 3> kLeast{0.0, 0.1, 0.3};
  const double crowding =
      std::sqrt(static_cast<double>(std::max<std::size_t>(links.size(), 1)) / 150.0);
  const double width = std::clamp(0.45 / crowding, 0.15, 0.45);
  for (std::size_t i = 0; i < kLeast.size(); ++i) {
    std::vector<Segment> drawn;
    for (const AliasLink& link : links) {
      const bool below = i + 1 < kLeast.size() && link.weight >= kLeast[i + 1];
      if (link.weight >= kLeast[i] && !below) drawn.push_back({link.place, link.alias});
    }
    canvas.segments(drawn, {faded(kLinkColour, 0.25 + 0.2 * static_cast<double>(i)), width});
  }
}

}  // namespace

const char* to_string(PlaceAnswer answer) {
  switch (answer) {
    case PlaceAnswer::unique:
      return "one answer";
    case PlaceAnswer::open:
      return "a direction open";
    case PlaceAnswer::ambiguous:
      return "ambiguous";
    case PlaceAnswer::lost:
      return "lost";
    case PlaceAnswer::wrong:
      break;
  }
  return "wrong";
}

Result<void> draw_aliases(const std::string& path, std::span<const Segment> plan,
                          std::span<const SurveyedPlace> places, std::span<const AliasLink> links,
                          const PictureOptions& options) {
  const double crowding =
      std::sqrt(static_cast<double>(std::max<std::size_t>(places.size(), 1)) / 800.0);
  const double shrink = std::clamp(1.0 / crowding, 0.35, 1.0);
  Canvas canvas;
  canvas.segments(plan, wall_stroke(plan, {}, kPlanColour));
  add_links(canvas, links);
  Sheet sheet(options);
  std::vector<LegendEntry> legend;
  for (const PlaceKind& kind : kKinds) {
    std::vector<Vector2d> drawn;
    for (const SurveyedPlace& place : places) {
      if (is_of(place, kind)) drawn.push_back(place.position);
    }
    if (drawn.empty()) continue;
    canvas.marks(drawn, {kind.shape, shrink * kind.size, kind.colour});
    legend.push_back({std::string(kind.name) + " (" + std::to_string(drawn.size()) + ")",
                      {},
                      MarkStyle{kind.shape, kind.size, kind.colour},
                      {},
                      {}});
  }
  sheet.add(std::move(canvas));
  for (LegendEntry& entry : legend) sheet.explain(std::move(entry));
  if (!links.empty()) {
    sheet.explain({"look the same", Stroke{faded(kLinkColour, 0.6), 0.6}, {}, {}, {}});
  }
  return sheet.write(path);
}

}  // namespace adit
