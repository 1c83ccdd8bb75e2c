#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "adit/survey/loop_search.hpp"

namespace adit {
namespace {

/// How two closures relate.
struct Agreement {
  bool consistent = true;  ///< no contradiction
  bool supports = false;   ///< and near enough for that to mean something
};

/// What a closure says of the drift: the motion of the map that brings its query home.
Pose2 correction(const Closure& c, std::span<const Pose2> poses) {
  return poses[c.from] * c.from_to * inverse(poses[c.to]);
}

/// Drift along the chain between two keyframes, from the sums over all keyframes before each.
struct ChainDrift {
  std::vector<double> metres2;
  std::vector<double> radians2;

  RelativeSigma between(std::size_t a, std::size_t b, double lever_m) const {
    const std::size_t low = std::min(a, b);
    const std::size_t high = std::max(a, b);
    const double radians = std::sqrt(radians2[high] - radians2[low]);
    const double metres = std::sqrt(metres2[high] - metres2[low]);
    return {true, std::hypot(metres, radians * lever_m), radians};
  }
};

ChainDrift chain_of(const LoopScene& scene) {
  ChainDrift chain;
  double metres2 = 0.0;
  double radians2 = 0.0;
  for (std::size_t i = 0; i < scene.keyframes.size(); ++i) {
    if (i > 0) {
      const Keyframe& k = scene.keyframes[i];
      const Matrix3d covariance =
          (k.tracked_information + k.odometry_covariance.inverse()).inverse();
      metres2 += covariance(0, 0) + covariance(1, 1);
      radians2 += covariance(2, 2);
    }
    chain.metres2.push_back(metres2);
    chain.radians2.push_back(radians2);
  }
  return chain;
}

Agreement compare(const LoopScene& scene, const ChainDrift& chain, const Closure& a,
                  const Closure& b, const LoopOptions& options) {
  const Vector2d here = scene.poses[a.to].translation();
  const double lever = (here - scene.poses[b.to].translation()).norm();
  const RelativeSigma queries = chain.between(a.to, b.to, lever);
  const RelativeSigma targets = chain.between(a.from, b.from, lever);
  const double metres2 = queries.metres * queries.metres + targets.metres * targets.metres;
  const double radians2 = queries.radians * queries.radians + targets.radians * targets.radians;
  const Pose2 by_a = correction(a, scene.poses);
  const Pose2 by_b = correction(b, scene.poses);
  const double shift2 = (by_a * here - by_b * here).squaredNorm();
  const double turn = angle_between(by_a.theta, by_b.theta);
  const double closure_m2 = 2.0 * options.closure_sigma_m * options.closure_sigma_m;
  const double closure_rad2 = 2.0 * options.closure_sigma_rad * options.closure_sigma_rad;
  Agreement out;
  out.consistent = shift2 / (closure_m2 + metres2) + turn * turn / (closure_rad2 + radians2) <=
                   options.consistent_chi_square;
  out.supports = out.consistent && std::sqrt(metres2) < options.support_m && a.to != b.to;
  return out;
}

}  // namespace

std::vector<Closure> consistent_set(const LoopScene& scene, std::span<const Closure> candidates,
                                    std::span<const Closure> known, const LoopOptions& options) {
  const ChainDrift chain = chain_of(scene);
  std::vector<Closure> sorted(candidates.begin(), candidates.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Closure& a, const Closure& b) { return a.to < b.to; });
  const std::size_t n = sorted.size();
  // Two whose queries drifted apart by more than this say nothing of each other.
  const double far = 4.0 * options.support_m;
  const auto end_of = [&](std::size_t i) {
    std::size_t j = i + 1;
    while (j < n && chain.between(sorted[i].to, sorted[j].to, 0.0).metres < far) ++j;
    return j;
  };
  std::vector<std::vector<std::size_t>> supporters(n);
  std::vector<std::vector<std::size_t>> opponents(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1, end = end_of(i); j < end; ++j) {
      const Agreement agreement = compare(scene, chain, sorted[i], sorted[j], options);
      if (agreement.supports) {
        supporters[i].push_back(j);
        supporters[j].push_back(i);
      } else if (!agreement.consistent) {
        opponents[i].push_back(j);
        opponents[j].push_back(i);
      }
    }
  }
  // Those with most support first; each joins unless it contradicts one that has.
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return supporters[a].size() > supporters[b].size();
  });
  std::vector<char> joined(n, 0);
  const auto has_joined = [&](std::size_t j) { return joined[j] != 0; };
  for (const std::size_t i : order) {
    joined[i] = std::none_of(opponents[i].begin(), opponents[i].end(), has_joined);
  }
  std::vector<Closure> accepted;
  for (std::size_t i = 0; i < n; ++i) {
    if (joined[i] == 0) continue;
    auto support = std::count_if(supporters[i].begin(), supporters[i].end(), has_joined);
    support += std::count_if(known.begin(), known.end(), [&](const Closure& k) {
      return compare(scene, chain, sorted[i], k, options).supports;
    });
    if (support >= options.least_support) accepted.push_back(sorted[i]);
  }
  return accepted;
}

}  // namespace adit
