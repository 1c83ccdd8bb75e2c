#include "demo_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "adit/plot/figures.hpp"

namespace adit {
namespace {

ViewFromPlace view_from(const LineMap& map, const Vector2d& place,
                        const LocalizerSettings& settings) {
  Visibility visibility;
  visibility.sweep(map, place, settings.scanner.max_range_m);
  ViewFromPlace view;
  view.position = place;
  view.intervals.assign(visibility.intervals().begin(), visibility.intervals().end());
  predict_features(map, visibility, place, settings.prediction, view.features);
  return view;
}

/// The piece of the scan with the most points, for the picture of the operator at work.
std::vector<Vector2d> longest_piece(const ScanPoints& points) {
  const auto& pieces = points.pieces();
  const auto longest = std::max_element(
      pieces.begin(), pieces.end(),
      [](const auto& a, const auto& b) { return a.end - a.begin < b.end - b.begin; });
  std::vector<Vector2d> piece;
  if (longest == pieces.end()) return piece;
  for (std::size_t i = longest->begin; i < longest->end; ++i) piece.push_back(points.point(i));
  return piece;
}

}  // namespace

Result<void> draw_demo_visibility(const std::filesystem::path& folder, const LineMap& map,
                                  const LocalizerSettings& settings) {
  const std::vector<ViewFromPlace> places = {view_from(map, {8.2, 3.3}, settings),
                                             view_from(map, {3.4, 12.5}, settings)};
  return draw_visible_features((folder / "fig04-visible-features.png").string(), plan_of(map),
                               places);
}

Result<void> draw_demo_turn(const std::filesystem::path& folder, const LineMap& map,
                            const Localizer& localizer, const LaserScan& scan) {
  const std::vector<Segment> plan = plan_of(map);
  const Turn turn = localizer.last_turn();
  const Vector2d observer = (turn.predicted.pose * scan.vehicle_from_laser).translation();
  MatchView match;
  match.plan = plan;
  match.model = &turn.model_features;
  match.map_from_model = {observer.x(), observer.y(), 0.0};
  match.sensed = &turn.sensed_features;
  match.map_from_sensed = localizer.estimate().pose * scan.vehicle_from_laser;
  match.pairs = localizer.estimate().pairs;
  const ScanView view{&scan, match.sensed, match.map_from_sensed, {}};
  const double sigma = std::sqrt(turn.extractor.points().noise().beam_variance);
  const CornerOperatorView work =
      slide_corner_operator(longest_piece(turn.extractor.points()), 1.5, sigma);
  const auto file = [&](const char* name) { return (folder / name).string(); };
  return draw_corner_operator(file("fig05-corner-operator.png"), work)
      .and_then([&] { return draw_scan(file("fig10-scan-with-features.png"), view); })
      .and_then(
          [&] { return draw_predicted_features(file("fig11-predicted-features.png"), match); })
      .and_then(
          [&] { return draw_extracted_features(file("fig12-extracted-features.png"), match); });
}

Result<void> draw_demo_paths(const std::filesystem::path& folder, const LineMap& map,
                             const std::vector<Pose2>& desired,
                             const std::vector<StampedPose>& truth,
                             const std::vector<Pose2>& estimated) {
  const std::vector<Segment> plan = plan_of(map);
  std::vector<Pose2> surveyed;
  for (const StampedPose& pose : truth) surveyed.push_back(pose.pose);
  return draw_motion_history((folder / "fig09-motion-history.png").string(), plan, desired,
                             estimated)
      .and_then([&] {
        return draw_paths((folder / "fig13-surveyed-and-estimated-path.png").string(), plan,
                          surveyed, estimated);
      });
}

}  // namespace adit
