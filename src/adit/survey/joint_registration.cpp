#include "adit/survey/joint_registration.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "adit/survey/drift.hpp"
#include "adit/threads/share_out.hpp"

namespace adit {
namespace {

constexpr std::size_t kPassGap = 25;  // keyframes; farther apart in time is another pass

/// Keyframes by place.
class PlaceGrid {
 public:
  PlaceGrid(std::span<const Pose2> poses, double side_m) : poses_(poses), side_(side_m) {
    for (std::size_t i = 0; i < poses.size(); ++i) cells_[cell_of(poses[i])].push_back(i);
  }

  /// Those before `i` within a cell's side of it, in order.
  std::vector<std::size_t> before(std::size_t i) const {
    std::vector<std::size_t> found;
    const auto [column, row] = cell_of(poses_[i]);
    for (long x = column - 1; x <= column + 1; ++x) {
      for (long y = row - 1; y <= row + 1; ++y) {
        const auto cell = cells_.find({x, y});
        if (cell == cells_.end()) continue;
        for (const std::size_t j : cell->second) {
          if (j >= i) break;
          if ((poses_[j].translation() - poses_[i].translation()).norm() <= side_) {
            found.push_back(j);
          }
        }
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  std::pair<long, long> cell_of(const Pose2& pose) const {
    return {std::lround(std::floor(pose.x / side_)), std::lround(std::floor(pose.y / side_))};
  }

  std::span<const Pose2> poses_;
  double side_;
  std::map<std::pair<long, long>, std::vector<std::size_t>> cells_;
};

/// The share of a scan's points, of every few, that find a wall of another.
double overlap(const Keyframe& source, const SurfaceMap& target, const Pose2& target_from_source,
               double reach_m) {
  constexpr std::size_t kStride = 6;
  const RigidTransform carry_by(target_from_source);
  int tried = 0;
  int matched = 0;
  for (std::size_t i = 0; i < source.shape.points.size(); i += kStride) {
    if (!source.shape.points[i].has_normal()) continue;
    const SurfacePoint p = carry(carry_by, source.shape.points[i]);
    ++tried;
    matched += target.nearest(p.point, p.normal, static_cast<float>(reach_m)) != nullptr;
  }
  return tried > 0 ? static_cast<double>(matched) / tried : 0.0;
}

class PairSearch {
 public:
  PairSearch(std::span<const Keyframe> keyframes, std::span<const Pose2> poses,
             std::span<const SurfaceMap> maps, const PlaceGrid& grid, const DriftBound& drift,
             const JointOptions& options, const AlignmentOptions& alignment)
      : keyframes_(keyframes),
        poses_(poses),
        maps_(maps),
        grid_(grid),
        drift_(drift, poses),
        options_(options),
        alignment_(alignment) {
    alignment_.first_reach_m = options.reach_m;
    // Of long drives fewer, but always one of another pass: else loops would open again.
    const int affordable =
        options.most_pairs / static_cast<int>(std::max<std::size_t>(1, keyframes.size()));
    options_.in_time = std::clamp(affordable / 2, 1, std::max(1, options.in_time));
    options_.neighbours = std::max(options_.in_time + 1, std::min(options.neighbours, affordable));
  }

  std::vector<PoseConstraint> of(std::size_t i) {
    std::vector<PoseConstraint> out;
    for (const std::size_t j : choose(i)) {
      add(j, i, out);
      add(i, j, out);
    }
    return out;
  }

 private:
  struct Offer {
    std::size_t keyframe;
    double share;
  };

  using Pass = std::vector<std::size_t>;

  /// Others near enough, one list for each pass; of very many passes some, evenly over all.
  std::vector<Pass> passes_near(std::size_t i, std::vector<std::size_t>& in_time) const {
    std::vector<Pass> passes;
    std::size_t last = 0;
    std::size_t count = 0;
    for (const std::size_t j : grid_.before(i)) {
      if (i - j <= static_cast<std::size_t>(options_.in_time)) {
        in_time.push_back(j);
        continue;
      }
      if (passes.empty() || j - last > kPassGap) passes.emplace_back();
      passes.back().push_back(j);
      last = j;
      ++count;
    }
    const std::size_t most = static_cast<std::size_t>(std::max(1, options_.most_looks));
    if (count <= most) return passes;
    const std::size_t kept = std::max<std::size_t>(1, passes.size() * most / count);
    std::vector<Pass> some;
    for (std::size_t k = 0; k < kept; ++k) {
      some.push_back(
          thinned(passes[(i + k * passes.size() / kept) % passes.size()], most / kept + 1));
    }
    std::sort(some.begin(), some.end());
    return some;
  }

  /// Evenly some of a pass, if it is longer than this.
  static Pass thinned(const Pass& pass, std::size_t most) {
    const std::size_t every = (pass.size() + most - 1) / most;
    Pass out;
    for (std::size_t k = 0; k < pass.size(); k += every) out.push_back(pass[k]);
    return out;
  }

  /// Leaves of the passes those whose pose is known well enough against one.
  void keep_believed(std::size_t i, std::vector<Pass>& passes) {
    std::vector<std::size_t> open;
    for (const Pass& pass : passes) open.insert(open.end(), pass.begin(), pass.end());
    std::vector<char> believed(open.size(), 0);
    const auto row_of = [&](std::size_t j) {
      const auto at = std::lower_bound(open.begin(), open.end(), j);
      return static_cast<std::size_t>(at - open.begin());
    };
    std::size_t wanted = open.size();
    drift_.begin(i);
    for (int looks = 0; wanted > 0 && looks < options_.most_reached; ++looks) {
      const auto reached = drift_.next(options_.believed_sigma_m);
      if (!reached) break;
      const std::size_t row = row_of(reached->node);
      if (row == open.size() || open[row] != reached->node) continue;
      believed[row] = 1;
      --wanted;
    }
    for (Pass& pass : passes) {
      std::erase_if(pass, [&](std::size_t j) { return believed[row_of(j)] == 0; });
    }
  }

  /// The best few of every pass, in turn.
  std::vector<std::size_t> choose(std::size_t i) {
    std::vector<std::size_t> chosen;
    std::vector<Pass> near = passes_near(i, chosen);
    keep_believed(i, near);
    std::vector<std::vector<Offer>> passes(near.size());
    for (std::size_t k = 0; k < near.size(); ++k) {
      for (const std::size_t j : near[k]) {
        const double share =
            overlap(keyframes_[i], maps_[j], inverse(poses_[j]) * poses_[i], options_.reach_m);
        if (share >= options_.least_share) passes[k].push_back({j, share});
      }
    }
    for (auto& pass : passes) {
      std::stable_sort(pass.begin(), pass.end(),
                       [](const Offer& a, const Offer& b) { return a.share > b.share; });
    }
    const std::size_t most = static_cast<std::size_t>(std::max(1, options_.neighbours));
    for (std::size_t rank = 0; chosen.size() < most; ++rank) {
      bool any = false;
      for (const auto& pass : passes) {
        if (rank >= pass.size() || chosen.size() >= most) continue;
        chosen.push_back(pass[rank].keyframe);
        any = true;
      }
      if (!any) break;
    }
    return chosen;
  }

  void add(std::size_t target, std::size_t source, std::vector<PoseConstraint>& out) const {
    PosePrior prior{inverse(poses_[target]) * poses_[source], Matrix3d::Zero()};
    const double m = 1.0 / options_.anchor_sigma_m;
    const double r = 1.0 / options_.anchor_sigma_rad;
    prior.information.diagonal() << m * m, m * m, r * r;
    const Alignment fit = align(keyframes_[source].shape.points, maps_[target], prior, prior.pose,
                                keyframes_[source].beam_sigma_m, alignment_);
    if (fit.matched_share < options_.least_share || fit.matched < 10) return;
    const Matrix3d floor =
        Vector3d(options_.pair_sigma_m, options_.pair_sigma_m, options_.pair_sigma_rad)
            .array()
            .square()
            .matrix()
            .asDiagonal();
    const Matrix3d open = Vector3d(1e-2, 1e-2, 1e-2).asDiagonal();
    const Matrix3d covariance = (fit.information + open).inverse() + floor;
    out.push_back(
        {target, source, fit.target_from_source, covariance.inverse(), options_.robust_sigmas});
  }

  std::span<const Keyframe> keyframes_;
  std::span<const Pose2> poses_;
  std::span<const SurfaceMap> maps_;
  const PlaceGrid& grid_;
  DriftSearch drift_;
  JointOptions options_;
  AlignmentOptions alignment_;
};

}  // namespace

std::vector<PoseConstraint> register_pairs(std::span<const Keyframe> keyframes,
                                           std::span<const Pose2> poses,
                                           std::span<const PoseConstraint> backbone,
                                           const JointOptions& options,
                                           const AlignmentOptions& alignment, int threads) {
  std::vector<SurfaceMap> maps(keyframes.size());
  share_out(keyframes.size(), threads, [&] {
    return [&](std::size_t i) {
      maps[i].add(keyframes[i].shape.points, RigidTransform(Pose2{}));
      maps[i].index();
    };
  });
  const PlaceGrid grid(poses, options.sight_m);
  const DriftBound drift(poses.size(), backbone);
  std::vector<std::vector<PoseConstraint>> found(keyframes.size());
  share_out(keyframes.size(), threads, [&] {
    return [&, search = PairSearch(keyframes, poses, maps, grid, drift, options, alignment)](
               std::size_t i) mutable { found[i] = search.of(i); };
  });
  std::vector<PoseConstraint> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace adit
