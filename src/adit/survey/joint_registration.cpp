#include "adit/survey/joint_registration.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "adit/relocation/share_out.hpp"
#include "adit/survey/drift.hpp"

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
        drift_(drift),
        options_(options),
        alignment_(alignment) {
    alignment_.first_reach_m = options.reach_m;
    const int affordable =
        options.most_pairs / static_cast<int>(std::max<std::size_t>(1, keyframes.size()));
    options_.neighbours = std::max(options.in_time, std::min(options.neighbours, affordable));
  }

  std::vector<PoseConstraint> of(std::size_t i) const {
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

  /// The best few of every pass, in turn.
  std::vector<std::size_t> choose(std::size_t i) const {
    const std::vector<RelativeSigma> sigma = drift_.from(i, poses_, options_.believed_sigma_m);
    std::vector<std::size_t> chosen;
    std::vector<std::vector<Offer>> passes;
    std::size_t last = 0;
    for (const std::size_t j : grid_.before(i)) {
      if (i - j <= static_cast<std::size_t>(options_.in_time)) {
        chosen.push_back(j);
        continue;
      }
      if (!sigma[j].known) continue;
      const double share =
          overlap(keyframes_[i], maps_[j], inverse(poses_[j]) * poses_[i], options_.reach_m);
      if (share < options_.least_share) continue;
      if (passes.empty() || j - last > kPassGap) passes.emplace_back();
      passes.back().push_back({j, share});
      last = j;
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
  const DriftBound& drift_;
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
               std::size_t i) { found[i] = search.of(i); };
  });
  std::vector<PoseConstraint> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace adit
