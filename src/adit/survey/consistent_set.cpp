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

/// Who supports and who contradicts each closure, by row.
struct Relations {
  std::vector<std::vector<std::size_t>> supporters;
  std::vector<std::vector<std::size_t>> opponents;
};

/// `rows` is in order of the queries; from `candidates` on closures have been accepted before and
/// are not held against each other.
Relations relate(const LoopScene& scene, const ChainDrift& chain, std::span<const Closure> closures,
                 std::size_t candidates, std::span<const std::size_t> rows,
                 const LoopOptions& options) {
  // Two whose queries drifted apart by more than this say nothing of each other.
  const double far = 4.0 * options.support_m;
  Relations out{std::vector<std::vector<std::size_t>>(closures.size()),
                std::vector<std::vector<std::size_t>>(closures.size())};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Closure& a = closures[rows[k]];
    for (std::size_t l = k + 1; l < rows.size(); ++l) {
      const Closure& b = closures[rows[l]];
      if (chain.between(a.to, b.to, 0.0).metres >= far) break;
      if (rows[k] >= candidates && rows[l] >= candidates) continue;
      const Agreement agreement = compare(scene, chain, a, b, options);
      if (agreement.consistent && !agreement.supports) continue;
      auto& list = agreement.supports ? out.supporters : out.opponents;
      list[rows[k]].push_back(rows[l]);
      list[rows[l]].push_back(rows[k]);
    }
  }
  return out;
}

/// Takes out the candidates that too few others support, until all that are left support each
/// other: what is dropped supports nothing. Whether there were any.
bool drop_unsupported(const Relations& relations, std::size_t candidates, int least,
                      std::vector<char>& joined, std::vector<char>& dropped) {
  bool any = false;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t row = 0; row < candidates; ++row) {
      if (joined[row] == 0) continue;
      const auto& supporters = relations.supporters[row];
      const auto support = std::count_if(supporters.begin(), supporters.end(),
                                         [&](std::size_t other) { return joined[other] != 0; });
      if (support >= least) continue;
      joined[row] = 0;
      dropped[row] = 1;
      changed = any = true;
    }
  }
  return any;
}

}  // namespace

std::vector<Closure> consistent_set(const LoopScene& scene, std::span<const Closure> candidates,
                                    std::span<const Closure> known, const LoopOptions& options) {
  const ChainDrift chain = chain_of(scene);
  std::vector<Closure> closures(candidates.begin(), candidates.end());
  closures.insert(closures.end(), known.begin(), known.end());
  std::vector<std::size_t> rows(closures.size());  // in order of their queries
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::stable_sort(rows.begin(), rows.end(),
                   [&](std::size_t a, std::size_t b) { return closures[a].to < closures[b].to; });
  const auto is_candidate = [&](std::size_t row) { return row < candidates.size(); };
  const Relations relations = relate(scene, chain, closures, candidates.size(), rows, options);
  std::vector<char> joined(closures.size(), 0);
  std::vector<char> dropped(closures.size(), 0);
  // Those with most support first; each joins unless it contradicts one that has. What is then
  // dropped for want of support makes room for what it contradicted.
  std::vector<std::size_t> order = rows;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return relations.supporters[a].size() > relations.supporters[b].size();
  });
  for (bool changed = true; changed;) {
    for (const std::size_t row : rows) joined[row] = is_candidate(row) ? 0 : 1;
    for (const std::size_t row : order) {
      if (!is_candidate(row) || dropped[row] != 0) continue;
      const auto& opponents = relations.opponents[row];
      joined[row] = std::none_of(opponents.begin(), opponents.end(),
                                 [&](std::size_t other) { return joined[other] != 0; });
    }
    changed =
        drop_unsupported(relations, candidates.size(), options.least_support, joined, dropped);
  }
  std::vector<Closure> accepted;
  for (const std::size_t row : rows) {
    if (is_candidate(row) && joined[row] != 0) accepted.push_back(closures[row]);
  }
  return accepted;
}

}  // namespace adit
