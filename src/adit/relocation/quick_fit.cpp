#include "adit/relocation/quick_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace adit {
namespace {

// From step to step returns must lie nearer to a wall to count (one sigma, m).
constexpr std::array<float, 2> kApproach{0.8F, 0.5F};
constexpr std::array<float, 3> kSettle{0.35F, 0.3F, 0.25F};

// How far the start may be off, one sigma (m, rad); what the returns leave open stays there.
constexpr float kStartMetres = 0.5F;
constexpr float kStartRadians = 0.06F;

// A return is behind a wall from so far on (m).
constexpr float kBehind = 0.6F;

struct Met {
  float off = 0.0F;  // from the wall (m)
  float normal_x = 0.0F;
  float normal_y = 0.0F;
  bool is_met = false;
};

inline Met meet(const WallField::Line& line, float x, float y) {
  const float dx = x - line.x;
  const float dy = y - line.y;
  const float along = dx * line.along_x + dy * line.along_y;
  const bool is_on_it =
      along >= -WallField::kBeyondEnd && along <= line.length + WallField::kBeyondEnd;
  if (!is_on_it) return {};
  return {dy * line.along_x - dx * line.along_y, -line.along_y, line.along_x, true};
}

/// Falls from one at the wall to none far from it.
inline float weight_of(float off, float sigma) {
  const float kernel = 1.0F / (1.0F + off * off / (sigma * sigma));
  return kernel * kernel;
}

}  // namespace

void QuickFit::set_scan(const LaserScan& scan, const ScannerModel& scanner, std::size_t beams) {
  points_.clear();
  const double no_return = scanner.no_return_from(scan.max_range);
  const std::size_t count = scan.beams_of_one_turn();
  const std::size_t stride = std::max<std::size_t>(1, count / std::max<std::size_t>(1, beams));
  for (std::size_t i = 0; i < count; i += stride) {
    const double range = scan.ranges[i];
    if (!(range > 0.0 && range >= scanner.min_range_m && range < no_return)) continue;
    const Vector2d point = range * unit_vector(scan.bearing(i));
    points_.push_back({static_cast<float>(point.x()), static_cast<float>(point.y())});
  }
}

QuickFit::Result QuickFit::approach(const WallField& field, const Pose2& map_from_laser) const {
  return fit(field, map_from_laser, kApproach);
}

QuickFit::Result QuickFit::settle(const WallField& field, const Pose2& map_from_laser) const {
  return fit(field, map_from_laser, kSettle);
}

QuickFit::Result QuickFit::fit(const WallField& field, const Pose2& map_from_laser,
                               std::span<const float> sigmas) const {
  const Vector2d start = map_from_laser.translation() - field.origin();
  Eigen::Vector3f moved = Eigen::Vector3f::Zero();
  const Eigen::Vector3f confidence(1.0F / (kStartMetres * kStartMetres),
                                   1.0F / (kStartMetres * kStartMetres),
                                   1.0F / (kStartRadians * kStartRadians));
  for (const float sigma : sigmas) {
    const Vector2d heading = unit_vector(map_from_laser.theta + static_cast<double>(moved.z()));
    const auto c = static_cast<float>(heading.x());
    const auto s = static_cast<float>(heading.y());
    const float x0 = static_cast<float>(start.x()) + moved.x();
    const float y0 = static_cast<float>(start.y()) + moved.y();
    float xx = 0, xy = 0, yy = 0, xt = 0, yt = 0, tt = 0, bx = 0, by = 0, bt = 0;
    for (const Point& point : points_) {
      const float rx = c * point.x - s * point.y;
      const float ry = s * point.x + c * point.y;
      const float x = x0 + rx;
      const float y = y0 + ry;
      const Met met = meet(field.line(field.nearest(x, y)), x, y);
      if (!met.is_met) continue;
      const float weight = weight_of(met.off, sigma);
      const float turn = met.normal_y * rx - met.normal_x * ry;
      const float wx = weight * met.normal_x;
      const float wy = weight * met.normal_y;
      xx += wx * met.normal_x;
      xy += wx * met.normal_y;
      yy += wy * met.normal_y;
      xt += wx * turn;
      yt += wy * turn;
      tt += weight * turn * turn;
      bx -= wx * met.off;
      by -= wy * met.off;
      bt -= weight * turn * met.off;
    }
    const float variance = sigma * sigma;
    Eigen::Matrix3f information;
    information << xx, xy, xt, xy, yy, yt, xt, yt, tt;
    information.diagonal() += variance * confidence;
    const Eigen::Vector3f score =
        Eigen::Vector3f(bx, by, bt) - variance * confidence.cwiseProduct(moved);
    moved += information.ldlt().solve(score);
  }
  Result result;
  result.map_from_laser = {map_from_laser.x + static_cast<double>(moved.x()),
                           map_from_laser.y + static_cast<double>(moved.y()),
                           wrap_angle(map_from_laser.theta + static_cast<double>(moved.z()))};
  result.agreement = agreement(field, result.map_from_laser, sigmas.back());
  return result;
}

float QuickFit::agreement(const WallField& field, const Pose2& map_from_laser,
                          float sigma_m) const {
  const Vector2d start = map_from_laser.translation() - field.origin();
  const Vector2d heading = unit_vector(map_from_laser.theta);
  return agreement(field,
                   {static_cast<float>(start.x()), static_cast<float>(start.y()),
                    static_cast<float>(heading.x()), static_cast<float>(heading.y())},
                   sigma_m);
}

/// Looks up all walls before it measures: the memory answers many questions at once.
float QuickFit::agreement(const WallField& field, const Placed& at, float sigma_m) const {
  constexpr std::size_t kAtOnce = 32;
  std::array<std::int32_t, kAtOnce> walls;
  std::array<Point, kAtOnce> placed;
  float sum = 0.0F;
  for (std::size_t first = 0; first < points_.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, points_.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Point& point = points_[first + i];
      placed[i] = {at.x + at.cosine * point.x - at.sine * point.y,
                   at.y + at.sine * point.x + at.cosine * point.y};
      walls[i] = field.nearest(placed[i].x, placed[i].y);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Met met = meet(field.line(walls[i]), placed[i].x, placed[i].y);
      sum += met.is_met ? weight_of(met.off, sigma_m) : 0.0F;
    }
  }
  return points_.empty() ? 0.0F : sum / static_cast<float>(points_.size());
}

float QuickFit::through(const WallField& field, const Pose2& map_from_laser) const {
  const Vector2d start = map_from_laser.translation() - field.origin();
  const Vector2d heading = unit_vector(map_from_laser.theta);
  const auto c = static_cast<float>(heading.x());
  const auto s = static_cast<float>(heading.y());
  const auto x0 = static_cast<float>(start.x());
  const auto y0 = static_cast<float>(start.y());
  int count = 0;
  for (const Point& point : points_) {
    const float x = x0 + c * point.x - s * point.y;
    const float y = y0 + s * point.x + c * point.y;
    count += field.is_between(x0, y0, x, y, kBehind);
  }
  return points_.empty() ? 0.0F : static_cast<float>(count) / static_cast<float>(points_.size());
}

}  // namespace adit
