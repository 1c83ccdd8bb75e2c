#include <algorithm>
#include <map>
#include <utility>

#include "adit/plot/figure_parts.hpp"
#include "adit/plot/figures.hpp"

namespace adit {
namespace {

constexpr FeatureStyle kModelStyle{kModelColour, 1.8, 4.4, true};
constexpr FeatureStyle kSensedStyle{kSensedColour, 1.2, 4.0, true};
constexpr FeatureStyle kUnmatchedStyle{kPaleGrey, 1.2, 3.6, false};

constexpr TextStyle numbers_in(const Colour& colour) { return {kNumberText.size, false, colour}; }

bool is_within(const FeatureList& features, FeatureKind kind, int index) {
  const std::size_t size =
      kind == FeatureKind::corner ? features.corners.size() : features.lines.size();
  return index >= 0 && static_cast<std::size_t>(index) < size;
}

enum class Side { sensed, model };

int index_of(const FeaturePair& pair, Side side) {
  return side == Side::sensed ? pair.sensed : pair.model;
}

/// Which features of one side have a pair.
FeatureSelection paired(const FeatureList& features, std::span<const FeaturePair> pairs,
                        Side side) {
  FeatureSelection selection{std::vector<char>(features.lines.size(), 0),
                             std::vector<char>(features.corners.size(), 0)};
  for (const FeaturePair& pair : pairs) {
    const int index = index_of(pair, side);
    if (!is_within(features, pair.kind, index)) continue;
    auto& list = pair.kind == FeatureKind::corner ? selection.corners : selection.lines;
    list[static_cast<std::size_t>(index)] = 1;
  }
  return selection;
}

FeatureSelection others(FeatureSelection selection) {
  const auto flip = [](char& keep) { keep = keep == 0 ? 1 : 0; };
  std::for_each(selection.lines.begin(), selection.lines.end(), flip);
  std::for_each(selection.corners.begin(), selection.corners.end(), flip);
  return selection;
}

/// Numbers from 1 in the order of the pairs; a feature of several pairs carries them all.
void add_numbers(Canvas& canvas, const FeatureList& features, const Pose2& map_from_features,
                 std::span<const FeaturePair> pairs, Side side, const Colour& colour) {
  std::map<std::pair<FeatureKind, int>, std::string> words;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const int index = index_of(pairs[i], side);
    if (!is_within(features, pairs[i].kind, index)) continue;
    std::string& text = words[{pairs[i].kind, index}];
    text += (text.empty() ? "" : ", ") + std::to_string(i + 1);
  }
  for (const auto& [feature, text] : words) {
    const Vector2d at = map_from_features * place_of(features, feature.first, feature.second);
    canvas.label(at, text, numbers_in(colour), feature.first == FeatureKind::corner ? 3.6 : 3.0);
  }
}

const FeatureList& list_or_none(const FeatureList* list, const FeatureList& none) {
  return list ? *list : none;
}

/// The same part of the map for all three pictures: the model's features, the paired sensed ones,
/// the robot.
Box match_view(const MatchView& view) {
  const FeatureList none;
  const FeatureList& model = list_or_none(view.model, none);
  const FeatureList& sensed = list_or_none(view.sensed, none);
  Box focus = box_around(model, view.map_from_model);
  for (const FeaturePair& pair : view.pairs) {
    if (!is_within(sensed, pair.kind, pair.sensed)) continue;
    const Vector2d at = view.map_from_sensed * place_of(sensed, pair.kind, pair.sensed);
    if (at.allFinite()) focus.extend(at);
  }
  if (focus.is_empty()) focus = box_around(sensed, view.map_from_sensed);
  const Vector2d robot = (view.sensed ? view.map_from_sensed : view.map_from_model).translation();
  if (robot.allFinite() && (view.sensed || view.model)) focus.extend(robot);
  return focused_view(view.plan, focus);
}

Canvas begin_match(const MatchView& view) {
  Canvas canvas;
  canvas.show(match_view(view));
  canvas.segments(view.plan, wall_stroke(view.plan, canvas.view(), kPlanColour));
  return canvas;
}

void explain_robot(Sheet& sheet) { sheet.explain({"robot", {}, kRobotMark, {}, {}}); }

void explain_unmatched(Sheet& sheet) {
  sheet.explain(
      {"not matched", Stroke{kUnmatchedStyle.colour, kUnmatchedStyle.line_width}, {}, {}, {}});
}

Result<void> draw_one_side(const std::string& path, const MatchView& view, Side side,
                           const PictureOptions& options) {
  const FeatureList none;
  const bool is_model = side == Side::model;
  const FeatureList& features = list_or_none(is_model ? view.model : view.sensed, none);
  const Pose2& pose = is_model ? view.map_from_model : view.map_from_sensed;
  const FeatureStyle& style = is_model ? kModelStyle : kSensedStyle;
  const FeatureSelection with_pair = paired(features, view.pairs, side);
  Canvas canvas = begin_match(view);
  // What was predicted stays in its colour: a prediction without a partner is no lesser one.
  FeatureStyle without = is_model ? kModelStyle : kUnmatchedStyle;
  if (is_model) without.colour = kSkyBlue;
  add_features(canvas, features, pose, without, others(with_pair));
  add_features(canvas, features, pose, style, with_pair);
  canvas.mark(pose.translation(), kRobotMark);
  add_numbers(canvas, features, pose, view.pairs, side, kInk);
  Sheet sheet(options);
  sheet.add(std::move(canvas));
  explain_features(sheet, style, is_model ? "predicted " : "extracted ");
  sheet.explain({"not matched", Stroke{without.colour, without.line_width}, {}, {}, {}});
  explain_robot(sheet);
  return sheet.write(path);
}

}  // namespace

Result<void> draw_predicted_features(const std::string& path, const MatchView& view,
                                     const PictureOptions& options) {
  return draw_one_side(path, view, Side::model, options);
}

Result<void> draw_extracted_features(const std::string& path, const MatchView& view,
                                     const PictureOptions& options) {
  return draw_one_side(path, view, Side::sensed, options);
}

Result<void> draw_match(const std::string& path, const MatchView& view,
                        const PictureOptions& options) {
  const FeatureList none;
  const FeatureList& model = list_or_none(view.model, none);
  const FeatureList& sensed = list_or_none(view.sensed, none);
  const FeatureSelection sensed_pairs = paired(sensed, view.pairs, Side::sensed);
  FeatureStyle wide = kModelStyle;
  wide.colour = kSkyBlue;
  wide.line_width = 3.6;
  wide.corner_size = 7.0;
  wide.bisectors = false;
  Canvas canvas = begin_match(view);
  add_features(canvas, model, view.map_from_model, wide);
  add_features(canvas, sensed, view.map_from_sensed, kUnmatchedStyle, others(sensed_pairs));
  add_features(canvas, sensed, view.map_from_sensed, kSensedStyle, sensed_pairs);
  canvas.mark(view.map_from_sensed.translation(), kRobotMark);
  add_numbers(canvas, sensed, view.map_from_sensed, view.pairs, Side::sensed, kInk);
  Sheet sheet(options);
  sheet.add(std::move(canvas));
  sheet.explain({"predicted", Stroke{wide.colour, wide.line_width}, {}, {}, {}});
  explain_features(sheet, kSensedStyle, "extracted ");
  explain_unmatched(sheet);
  explain_robot(sheet);
  return sheet.write(path);
}

Result<void> draw_visible_features(const std::string& path, std::span<const Segment> plan,
                                   std::span<const ViewFromPlace> places,
                                   const PictureOptions& options) {
  Box focus;
  for (const ViewFromPlace& place : places) {
    focus.extend(place.position);
    for (const VisibleInterval& interval : place.intervals) {
      focus.extend(place.position + interval.begin);
      focus.extend(place.position + interval.end);
    }
  }
  const Box view = focused_view(plan, focus);
  FeatureStyle corners = kModelStyle;
  corners.line_width = places.size() > 1 ? 1.4 : 1.8;
  corners.corner_size = places.size() > 1 ? 3.4 : 4.4;
  std::vector<Panel> panels;
  for (const ViewFromPlace& place : places) {
    const Pose2 pose{place.position.x(), place.position.y(), 0.0};
    Canvas canvas;
    canvas.show(view);
    canvas.segments(plan, wall_stroke(plan, view, kPlanColour));
    std::vector<Segment> seen;
    for (const VisibleInterval& interval : place.intervals) {
      seen.push_back({place.position + interval.begin, place.position + interval.end});
      const std::vector<Vector2d> fan{place.position, seen.back().a, seen.back().b};
      canvas.area(fan, faded(kSkyBlue, 0.16), std::nullopt);
    }
    canvas.segments(seen, {kModelColour, corners.line_width});
    FeatureSelection no_lines;
    no_lines.lines.assign(place.features.lines.size(), 0);
    add_features(canvas, place.features, pose, corners, no_lines);
    canvas.mark(place.position, kRobotMark);
    if (places.size() > 1) {
      canvas.caption("(" + std::string(1, static_cast<char>('a' + panels.size() % 26)) + ")");
    }
    panels.emplace_back(std::move(canvas));
  }
  if (panels.empty()) return draw_map(path, plan, options);
  Sheet sheet(options);
  sheet.add_row(std::move(panels));
  sheet.explain({"hidden wall", wall_stroke(plan, view, kPlanColour), {}, {}, {}});
  explain_features(sheet, corners, "visible ");
  sheet.explain({"robot", {}, kRobotMark, {}, {}});
  return sheet.write(path);
}

}  // namespace adit
