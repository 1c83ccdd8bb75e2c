#include "adit/relocation/quick_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "adit/relocation/wide_vectors.hpp"
#include "adit/scan/returns.hpp"

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

constexpr std::size_t kLanes = QuickFit::kLanes;

using Lanes = QuickFit::Lanes;

/// The pose at which returns are placed, relative to the field's origin.
using Placed = QuickFit::Placed;

/// The walls nearest to some returns, of each one the parts of a `WallField::Line`.
struct Walls {
  Lanes x;
  Lanes y;
  Lanes along_x;
  Lanes along_y;
  Lanes length;
};

/// Some returns relative to the scanner, in map axes, and how far they are from their walls.
struct Offs {
  Lanes x;
  Lanes y;
  Lanes off;     // along the normal (m)
  Lanes weight;  // from one at the wall to none far from it and beyond its ends
  Walls walls;
};

/// What a return counts that is so many sigma, squared, off its wall: one there, none far from it.
inline float weight_of(float squared) {
  const float kernel = 1.0F / (1.0F + squared);
  return kernel * kernel;
}

/// Looks up all walls before it measures: the memory answers many questions at once.
inline void meet(const WallField& field, const QuickFit::Returns& returns, const Placed& at,
                 float per_variance, Offs& out) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    out.x[i] = at.cosine * returns.x[i] - at.sine * returns.y[i];
    out.y[i] = at.sine * returns.x[i] + at.cosine * returns.y[i];
  }
  Walls& walls = out.walls;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const auto& line = field.line(field.nearest(at.x + out.x[i], at.y + out.y[i]));
    walls.x[i] = line.x;
    walls.y[i] = line.y;
    walls.along_x[i] = line.along_x;
    walls.along_y[i] = line.along_y;
    walls.length[i] = line.length;
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float dx = at.x + out.x[i] - walls.x[i];
    const float dy = at.y + out.y[i] - walls.y[i];
    const float along = dx * walls.along_x[i] + dy * walls.along_y[i];
    const float beyond = along - walls.length[i];
    const float farthest = beyond > -along ? beyond : -along;
    const float off = dy * walls.along_x[i] - dx * walls.along_y[i];
    const float is_met = farthest > WallField::kBeyondEnd ? 0.0F : 1.0F;
    out.off[i] = off;
    out.weight[i] = is_met * returns.counts[i] * weight_of(off * off * per_variance);
  }
}

/// Weighted sums for a step, of each lane.
struct Sums {
  Lanes xx{}, xy{}, yy{}, xt{}, yt{}, tt{}, bx{}, by{}, bt{};

  void add(const Offs& met) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const float nx = -met.walls.along_y[i];
      const float ny = met.walls.along_x[i];
      const float turn = ny * met.x[i] - nx * met.y[i];
      const float wx = met.weight[i] * nx;
      const float wy = met.weight[i] * ny;
      const float wt = met.weight[i] * turn;
      xx[i] += wx * nx;
      xy[i] += wx * ny;
      yy[i] += wy * ny;
      xt[i] += wx * turn;
      yt[i] += wy * turn;
      tt[i] += wt * turn;
      bx[i] -= wx * met.off[i];
      by[i] -= wy * met.off[i];
      bt[i] -= wt * met.off[i];
    }
  }
};

float sum_of(const Lanes& lanes) {
  float sum = 0.0F;
  for (const float lane : lanes) sum += lane;
  return sum;
}

ADIT_WIDE Sums sums_at(const WallField& field, std::span<const QuickFit::Returns> returns,
                       const Placed& at, float per_variance) {
  Sums sums;
  Offs met;
  for (const QuickFit::Returns& some : returns) {
    meet(field, some, at, per_variance, met);
    sums.add(met);
  }
  return sums;
}

ADIT_WIDE float weight_at(const WallField& field, std::span<const QuickFit::Returns> returns,
                          const Placed& at, float per_variance) {
  Lanes weights{};
  Offs met;
  for (const QuickFit::Returns& some : returns) {
    meet(field, some, at, per_variance, met);
    for (std::size_t i = 0; i < kLanes; ++i) weights[i] += met.weight[i];
  }
  return sum_of(weights);
}

}  // namespace

void QuickFit::set_scan(const LaserScan& scan, const ScannerModel& scanner, std::size_t beams) {
  returns_.clear();
  count_ = 0;
  const ReturnLimits limits = return_limits(scan, scanner);
  const std::size_t count = scan.beams_of_one_turn();
  const std::size_t stride = std::max<std::size_t>(1, count / std::max<std::size_t>(1, beams));
  for (std::size_t i = 0; i < count; i += stride) {
    const double range = scan.ranges[i];
    if (!limits.is_return(range)) continue;
    const Vector2d point = range * unit_vector(scan.bearing(i));
    const std::size_t lane = count_++ % kLanes;
    if (lane == 0) returns_.emplace_back();
    returns_.back().x[lane] = static_cast<float>(point.x());
    returns_.back().y[lane] = static_cast<float>(point.y());
    returns_.back().counts[lane] = 1.0F;
  }
}

QuickFit::Result QuickFit::approach(const WallField& field, const Pose2& map_from_laser) const {
  return fit(field, map_from_laser, kApproach);
}

QuickFit::Result QuickFit::settle(const WallField& field, const Pose2& map_from_laser) const {
  return fit(field, map_from_laser, kSettle);
}

/// A pose relative to the field's origin, moved by this (m, rad).
static Placed placed(const WallField& field, const Pose2& pose, const Eigen::Vector3f& moved) {
  const Vector2d start = pose.translation() - field.origin();
  const Vector2d heading = unit_vector(pose.theta + static_cast<double>(moved.z()));
  return {static_cast<float>(start.x()) + moved.x(), static_cast<float>(start.y()) + moved.y(),
          static_cast<float>(heading.x()), static_cast<float>(heading.y())};
}

QuickFit::Result QuickFit::fit(const WallField& field, const Pose2& map_from_laser,
                               std::span<const float> sigmas) const {
  Eigen::Vector3f moved = Eigen::Vector3f::Zero();
  const Eigen::Vector3f confidence(1.0F / (kStartMetres * kStartMetres),
                                   1.0F / (kStartMetres * kStartMetres),
                                   1.0F / (kStartRadians * kStartRadians));
  for (const float sigma : sigmas) {
    const float variance = sigma * sigma;
    const Sums sums =
        sums_at(field, returns_, placed(field, map_from_laser, moved), 1.0F / variance);
    const float xy = sum_of(sums.xy);
    const float xt = sum_of(sums.xt);
    const float yt = sum_of(sums.yt);
    Eigen::Matrix3f information;
    information << sum_of(sums.xx), xy, xt, xy, sum_of(sums.yy), yt, xt, yt, sum_of(sums.tt);
    information.diagonal() += variance * confidence;
    const Eigen::Vector3f score =
        Eigen::Vector3f(sum_of(sums.bx), sum_of(sums.by), sum_of(sums.bt)) -
        variance * confidence.cwiseProduct(moved);
    moved += information.ldlt().solve(score);
  }
  Result result;
  result.map_from_laser = {map_from_laser.x + static_cast<double>(moved.x()),
                           map_from_laser.y + static_cast<double>(moved.y()),
                           wrap_angle(map_from_laser.theta + static_cast<double>(moved.z()))};
  const Placed at = placed(field, result.map_from_laser, Eigen::Vector3f::Zero());
  result.agreement = agreement(field, at, sigmas.back());
  return result;
}

float QuickFit::agreement(const WallField& field, const Placed& at, float sigma_m) const {
  if (count_ == 0) return 0.0F;
  return weight_at(field, returns_, at, 1.0F / (sigma_m * sigma_m)) / static_cast<float>(count_);
}

QuickFit::OffWeights QuickFit::off_weights(float sigma_m) {
  OffWeights weights{};
  for (std::size_t code = 0; code < WallField::kFarOff; ++code) {
    const float off = WallField::kOffStep * (static_cast<float>(code) + 0.5F);
    weights[code] = weight_of(off * off / (sigma_m * sigma_m));
  }
  return weights;
}

float QuickFit::rough_agreement(const WallField& field, const Placed& at,
                                const OffWeights& weights) const {
  if (count_ == 0) return 0.0F;
  float sum = 0.0F;
  for (const Returns& returns : returns_) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const float x = at.x + (at.cosine * returns.x[i] - at.sine * returns.y[i]);
      const float y = at.y + (at.sine * returns.x[i] + at.cosine * returns.y[i]);
      sum += returns.counts[i] * weights[field.off_code(x, y)];
    }
  }
  return sum / static_cast<float>(count_);
}

float QuickFit::through(const WallField& field, const Pose2& map_from_laser) const {
  if (count_ == 0) return 0.0F;
  const Placed at = placed(field, map_from_laser, Eigen::Vector3f::Zero());
  int count = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const float px = returns_[i / kLanes].x[i % kLanes];
    const float py = returns_[i / kLanes].y[i % kLanes];
    const float x = at.x + at.cosine * px - at.sine * py;
    const float y = at.y + at.sine * px + at.cosine * py;
    count += field.is_between(at.x, at.y, x, y, kBehind);
  }
  return static_cast<float>(count) / static_cast<float>(count_);
}

}  // namespace adit
