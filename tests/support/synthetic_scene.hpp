#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "adit/features/features.hpp"
#include "support/draws.hpp"

namespace adit::testing {

/// What a synthetic scene is made of.
struct SceneOptions {
  int walls = 12;          ///< of a room that is star-shaped about the observer
  int boxes = 0;           ///< clutter: two faces, their common corner and their two edges each
  double fragments = 0.0;  ///< share of the walls that are sensed in two pieces
  double lost_arms = 0.0;  ///< share of the sensed corners that show one arm only
  double range_sigma =
      0.1;  ///< noise of the 1000 points that the features come from (m); 0 for none
  double position_error = 0.4;  ///< largest error of the predicted pose (m)
  double heading_error = 0.05;  ///< rad
};

/// Features as the matcher gets them, and which belong together.
struct Scene {
  FeatureList sensed;
  FeatureList model;
  std::vector<FeaturePair> truth;
  Pose2 sensed_from_model;
};

/// Makes scenes without scanner or map: a room whose corners and walls are all visible.
class SceneMaker {
 public:
  explicit SceneMaker(std::uint64_t seed) : random_(seed) {}

  Scene make(const SceneOptions& options) {
    options_ = options;
    Scene scene;
    add_room(scene);
    scene.sensed_from_model = random_error();
    FeatureList moved;
    transform(scene.model, scene.sensed_from_model, moved);
    sense(moved, scene);
    for (int box = 0; box < options.boxes; ++box) add_box(scene.sensed);
    sort_counter_clockwise(scene.model);
    sort_counter_clockwise(scene.sensed);
    return scene;
  }

  double uniform(double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(random_() >> 11);
  }
  double gaussian() {
    double sum = 0.0;
    for (int i = 0; i < 12; ++i) sum += uniform(-0.5, 0.5);
    return sum;
  }

 private:
  static Line line_between(const Vector2d& begin, const Vector2d& end) {
    Line line;
    line.begin = begin;
    line.end = end;
    const Vector2d normal = -perpendicular((end - begin).normalized());
    line.orientation = std::atan2(normal.y(), normal.x());
    line.distance = normal.dot(begin);
    return line;
  }

  static Corner corner_between(const Vector2d& before, const Vector2d& vertex,
                               const Vector2d& after) {
    Corner corner;
    corner.position = vertex;
    const Vector2d u = (before - vertex).normalized();
    const Vector2d v = (after - vertex).normalized();
    corner.concave_angle = std::acos(std::clamp(u.dot(v), -1.0, 1.0));
    corner.bisector = std::atan2((u + v).y(), (u + v).x());
    return corner;
  }

  Pose2 random_error() {
    const double direction = uniform(-kPi, kPi);
    const double size = uniform(0.0, options_.position_error);
    return {size * std::cos(direction), size * std::sin(direction),
            uniform(-options_.heading_error, options_.heading_error)};
  }

  void add_room(Scene& scene) {
    const int count = options_.walls;
    std::vector<Vector2d> vertices;
    for (int i = 0; i < count; ++i) {
      const double azimuth = kTwoPi * (i + uniform(-0.3, 0.3)) / count;
      vertices.push_back(uniform(3.0, 12.0) * unit_vector(azimuth));
    }
    for (int i = 0; i < count; ++i) {
      const auto at = [&](int k) {
        return vertices[static_cast<std::size_t>((k + count) % count)];
      };
      scene.model.lines.push_back(line_between(at(i), at(i + 1)));
      scene.model.corners.push_back(corner_between(at(i - 1), at(i), at(i + 1)));
      scene.model.corners.back().arms = {(i + count - 1) % count, i};
    }
  }

  // Noise as a line fit to the wall's points would have it; returns the error of the orientation.
  double disturb(Line& line) {
    const double angle =
        std::acos(std::clamp(line.begin.normalized().dot(line.end.normalized()), -1.0, 1.0));
    line.points = std::max(3, static_cast<int>(angle * 1000.0 / kTwoPi));
    const double variance = options_.range_sigma * options_.range_sigma / line.points;
    const double length = std::max(0.05, line.length());
    const Vector2d normal = unit_vector(line.orientation);
    const double lever = perpendicular(normal).dot(0.5 * (line.begin + line.end));
    const double of_angle = 12.0 * variance / (length * length);
    line.covariance << of_angle, lever * of_angle, lever * of_angle,
        lever * lever * of_angle + variance;
    const double turn = std::sqrt(of_angle) * gaussian();
    line.orientation = wrap_angle(line.orientation + turn);
    line.distance += lever * turn + std::sqrt(variance) * gaussian();
    const Vector2d new_normal = unit_vector(line.orientation);
    line.begin += (line.distance - new_normal.dot(line.begin)) * new_normal;
    line.end += (line.distance - new_normal.dot(line.end)) * new_normal;
    return turn;
  }

  void disturb(Corner& corner, double sigma_before, double sigma_after, int points) {
    const double sigma = 0.5 * options_.range_sigma;
    corner.covariance = sigma * sigma * Matrix2d::Identity();
    corner.position += sigma * test::drawn<2>([&] { return gaussian(); });
    corner.points = points;
    if (!corner.bisector) return;
    corner.concave_angle_sigma = std::hypot(sigma_before, sigma_after);
    corner.bisector_sigma = 0.5 * corner.concave_angle_sigma;
    *corner.concave_angle += corner.concave_angle_sigma * gaussian();
    corner.bisector = wrap_angle(*corner.bisector + corner.bisector_sigma * gaussian());
  }

  void sense(const FeatureList& moved, Scene& scene) {
    FeatureList& out = scene.sensed;
    const auto add_line = [&](Line line, int model) {
      disturb(line);
      scene.truth.push_back({FeatureKind::line, static_cast<int>(out.lines.size()), model});
      out.lines.push_back(line);
    };
    std::vector<int> first_piece;
    std::vector<int> last_piece;
    for (std::size_t i = 0; i < moved.lines.size(); ++i) {
      const Line& line = moved.lines[i];
      first_piece.push_back(static_cast<int>(out.lines.size()));
      if (uniform(0.0, 1.0) < options_.fragments) {
        const Vector2d along = line.end - line.begin;
        add_line(line_between(line.begin, line.begin + uniform(0.3, 0.45) * along),
                 static_cast<int>(i));
        add_line(line_between(line.begin + uniform(0.55, 0.7) * along, line.end),
                 static_cast<int>(i));
      } else {
        add_line(line, static_cast<int>(i));
      }
      last_piece.push_back(static_cast<int>(out.lines.size()) - 1);
    }
    for (std::size_t i = 0; i < moved.corners.size(); ++i) {
      Corner corner = moved.corners[i];
      corner.arms = {last_piece[static_cast<std::size_t>(corner.arms[0])],
                     first_piece[static_cast<std::size_t>(corner.arms[1])]};
      const Line& before = out.lines[static_cast<std::size_t>(corner.arms[0])];
      const Line& after = out.lines[static_cast<std::size_t>(corner.arms[1])];
      if (uniform(0.0, 1.0) < options_.lost_arms) {
        corner.arms[uniform(0.0, 1.0) < 0.5 ? 0 : 1] = -1;
        corner.concave_angle.reset();
        corner.bisector.reset();
      }
      disturb(corner, std::sqrt(before.covariance(0, 0)), std::sqrt(after.covariance(0, 0)),
              before.points + after.points);
      const int index = static_cast<int>(out.corners.size());
      scene.truth.push_back({FeatureKind::corner, index, static_cast<int>(i)});
      out.corners.push_back(corner);
    }
  }

  void add_box(FeatureList& out) {
    const double azimuth = uniform(-kPi, kPi);
    const Vector2d edge = uniform(1.0, 8.0) * unit_vector(azimuth);
    const Vector2d to_before = unit_vector(azimuth - uniform(0.4, 1.2));
    const Vector2d before = edge + uniform(0.4, 1.2) * to_before;
    const Vector2d to_after = unit_vector(azimuth + uniform(0.4, 1.2));
    const Vector2d after = edge + uniform(0.4, 1.2) * to_after;
    const int first = static_cast<int>(out.lines.size());
    out.lines.push_back(line_between(before, edge));
    out.lines.push_back(line_between(edge, after));
    disturb(out.lines[static_cast<std::size_t>(first)]);
    disturb(out.lines[static_cast<std::size_t>(first) + 1]);
    out.corners.push_back(corner_between(before, edge, after));
    out.corners.back().arms = {first, first + 1};
    for (int side = 0; side < 2; ++side) {
      Corner occluding;
      occluding.position = side == 0 ? before : after;
      occluding.occluding = true;
      occluding.arms = side == 0 ? std::array{-1, first} : std::array{first + 1, -1};
      out.corners.push_back(occluding);
    }
    for (std::size_t i = out.corners.size() - 3; i < out.corners.size(); ++i) {
      disturb(out.corners[i], 0.1, 0.1, 10);
    }
  }

  std::mt19937_64 random_;
  SceneOptions options_;
};

}  // namespace adit::testing
