#include "adit/matching/feature_view.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

bool is_clique(const MatchingOptions& options) {
  return options.consistency == Consistency::clique;
}

// How far something `distance` away may seem to turn when the observer stands up to poserr off.
double parallax_at(double distance, const MatchingOptions& options) {
  if (!is_clique(options)) return 0.0;
  const double reach = options.poserr + options.map_disterr;
  // Inside the reach the observer may have passed it, and it may lie in any direction.
  return reach < distance ? std::asin(reach / distance) : kPi;
}

// The root of the squares of what the plan errs and `noise`, a squared deviation.
double slack(double map_error, double noise, const MatchingOptions& options) {
  return is_clique(options) ? std::sqrt(map_error * map_error + noise) : 0.0;
}

bool is_usable(const Corner& corner) {
  return corner.position.allFinite() && corner.covariance.allFinite();
}

bool is_usable(const Line& line) {
  return line.begin.allFinite() && line.end.allFinite() && std::isfinite(line.orientation) &&
         std::isfinite(line.distance) && line.covariance.allFinite();
}

}  // namespace

CornerView view_of(const Corner& corner, const MatchingOptions& options) {
  CornerView view;
  view.corner = &corner;
  view.azimuth = std::atan2(corner.position.y(), corner.position.x());
  view.distance = corner.position.norm();
  view.parallax = parallax_at(view.distance, options);

  const double factor = noise_factor(options);
  const Vector2d ray =
      view.distance > 0.0 ? Vector2d(corner.position / view.distance) : Vector2d::UnitX();
  // The noise of a corner excuses no more than terndisterr, here as between pairs.
  const double most = options.terndisterr * options.terndisterr;
  const Vector2d across = perpendicular(ray);
  const double radial = std::clamp(factor * ray.dot(corner.covariance * ray), 0.0, most);
  const double lateral = std::clamp(factor * across.dot(corner.covariance * across), 0.0, most);
  const double sigmas = std::sqrt(factor);
  view.azimuth_gate = options.angerr;
  // Beyond half its distance the noise of a corner says nothing about its bearing.
  if (lateral > 0.0) {
    const double ratio = std::sqrt(lateral) / view.distance;
    view.azimuth_gate = ratio < 0.5 ? options.angerr + std::asin(ratio) : kPi;
  }
  view.distance_gate = options.poserr + slack(options.map_disterr, radial, options);
  view.concave_gate = options.concerr + sigmas * corner.concave_angle_sigma;
  view.bisector_gate =
      options.angerr +
      slack(options.map_angerr, factor * corner.bisector_sigma * corner.bisector_sigma, options);
  return view;
}

LineView view_of(const Line& line, const MatchingOptions& options) {
  LineView view;
  view.line = &line;
  view.normal = unit_vector(line.orientation);
  view.tangent = perpendicular(view.normal);
  view.along_begin = view.tangent.dot(line.begin);
  view.along_end = view.tangent.dot(line.end);
  // Noise can turn a very short line round; its extent is still the stretch between its ends.
  if (view.along_end < view.along_begin) std::swap(view.along_begin, view.along_end);
  view.begin_azimuth = std::atan2(line.begin.y(), line.begin.x());
  const double end_azimuth = std::atan2(line.end.y(), line.end.x());
  view.azimuth = view.begin_azimuth;
  view.subtended = turn_between(view.begin_azimuth, end_azimuth);
  if (view.subtended < 0.0) {
    // Seen from its own line a wall may come out clockwise by rounding: it subtends nothing.
    view.subtended = view.subtended > -1e-6 ? 0.0 : view.subtended + kTwoPi;
  }
  view.begin_parallax = parallax_at(line.begin.norm(), options);
  view.end_parallax = parallax_at(line.end.norm(), options);

  const double factor = noise_factor(options);
  const double of_angle = std::max(0.0, line.covariance(0, 0));
  const double of_distance = std::max(0.0, line.covariance(1, 1));
  view.lever = of_angle > 0.0 ? line.covariance(0, 1) / of_angle : 0.0;
  view.orientation_noise = factor * of_angle;
  view.centroid_noise = factor * std::max(0.0, of_distance - view.lever * view.lever * of_angle);
  view.azimuth_gate = options.angerr;
  view.orientation_gate =
      options.angerr + slack(options.map_angerr, view.orientation_noise, options);
  return view;
}

SteadiedLine steady(const LineView& line, double turn, double noise) {
  SteadiedLine steadied;
  steadied.shift_noise = line.centroid_noise;
  if (line.orientation_noise <= 0.0) return steadied;
  const double gain = line.orientation_noise / (line.orientation_noise + noise);
  steadied.turn = -gain * turn;
  steadied.shift = line.lever * steadied.turn;
  steadied.slide = -line.line->distance * steadied.turn;
  steadied.turn_noise = (1.0 - gain) * line.orientation_noise;
  steadied.shift_noise += line.lever * line.lever * steadied.turn_noise;
  steadied.slide_noise = line.line->distance * line.line->distance * steadied.turn_noise;
  return steadied;
}

void make_views(const FeatureList& features, const MatchingOptions& options, FeatureViews& out) {
  out.corners.clear();
  out.lines.clear();
  out.order.clear();
  out.features = &features;
  for (const FeatureRef& ref : features.order) {
    FeatureRef place{ref.kind, 0, ref.azimuth};
    const int rank = static_cast<int>(out.order.size());
    if (ref.kind == FeatureKind::corner) {
      const Corner& corner = features.corners[static_cast<std::size_t>(ref.index)];
      if (!is_usable(corner)) continue;
      place.index = static_cast<int>(out.corners.size());
      out.corners.push_back(view_of(corner, options));
      out.corners.back().index = ref.index;
      out.corners.back().rank = rank;
    } else {
      const Line& line = features.lines[static_cast<std::size_t>(ref.index)];
      if (!is_usable(line)) continue;
      place.index = static_cast<int>(out.lines.size());
      out.lines.push_back(view_of(line, options));
      out.lines.back().index = ref.index;
      out.lines.back().rank = rank;
      out.lines.back().azimuth = ref.azimuth;
    }
    out.order.push_back(place);
  }
}

}  // namespace adit
