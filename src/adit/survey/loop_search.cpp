#include "adit/survey/loop_search.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "adit/threads/share_out.hpp"

namespace adit {
namespace {

/// One place to be compared with another.
struct Candidate {
  std::size_t query = 0;
  RelativeSigma sigma;
};

std::size_t apart(std::size_t a, std::size_t b) { return a > b ? a - b : b - a; }

/// Keyframes as seen from one of them.
std::vector<PlacedShape> shapes_of(const LoopScene& scene, std::size_t middle, std::size_t begin,
                                   std::size_t end) {
  const Pose2 middle_from_map = inverse(scene.poses[middle]);
  std::vector<PlacedShape> shapes;
  for (std::size_t i = begin; i < end; ++i) {
    shapes.push_back({&scene.keyframes[i].shape, middle_from_map * scene.poses[i]});
  }
  return shapes;
}

/// Keyframes around one, as seen from it.
std::vector<PlacedShape> around(const LoopScene& scene, std::size_t middle, int count) {
  const std::size_t half = static_cast<std::size_t>(count / 2);
  return shapes_of(scene, middle, middle > half ? middle - half : 0,
                   std::min(scene.keyframes.size(), middle + half + 1));
}

/// Closures by their queries.
class KnownClosures {
 public:
  explicit KnownClosures(std::span<const Closure> known) {
    for (const Closure& c : known) rows_.emplace_back(c.to, c.from);
    std::sort(rows_.begin(), rows_.end());
  }

  /// Whether one says already what a target and a query would.
  bool hold(std::size_t target, std::size_t query, const LoopOptions& options) const {
    const auto stride = static_cast<std::size_t>(options.query_stride);
    const std::size_t first = query + 1 > stride ? query + 1 - stride : 0;
    auto row = std::lower_bound(rows_.begin(), rows_.end(), Row{first, 0});
    for (; row != rows_.end() && row->first < query + stride; ++row) {
      if (apart(row->second, target) <= static_cast<std::size_t>(options.target_keyframes)) {
        return true;
      }
    }
    return false;
  }

 private:
  using Row = std::pair<std::size_t, std::size_t>;
  std::vector<Row> rows_;
};

/// Where the way since one keyframe, or back from it, becomes longer than this: the first that is
/// left out, but none from `limit` on.
std::size_t way_end(const LoopScene& scene, std::size_t middle, double way_m, std::size_t limit) {
  std::size_t end = middle + 1;
  for (double way = 0.0; end < limit; ++end) {
    way += (scene.poses[end].translation() - scene.poses[end - 1].translation()).norm();
    if (way > way_m) break;
  }
  return end;
}

std::size_t way_begin(const LoopScene& scene, std::size_t middle, double way_m) {
  std::size_t begin = middle;
  for (double way = 0.0; begin > 0; --begin) {
    way += (scene.poses[begin].translation() - scene.poses[begin - 1].translation()).norm();
    if (way > way_m) break;
  }
  return begin;
}

/// Compares one target with all its queries.
class TargetSearch {
 public:
  TargetSearch(const LoopScene& scene, const LoopOptions& options,
               const AlignmentOptions& alignment)
      : scene_(scene), options_(options), alignment_(alignment) {}

  std::vector<Closure> search(std::size_t target, std::span<const Candidate> candidates) {
    std::vector<Closure> found;
    if (candidates.empty()) return found;
    const std::vector<PlacedShape> shapes = around(scene_, target, options_.target_keyframes);
    field_.build(shapes, true, options_.grid);
    map_.clear();
    for (const PlacedShape& s : shapes) {
      map_.add(s.shape->points, RigidTransform(s.frame_from_shape));
    }
    map_.index();
    surroundings_end_ = 0;
    for (const Candidate& candidate : candidates) {
      if (auto closure = compare(target, candidate)) found.push_back(*closure);
    }
    return found;
  }

 private:
  std::optional<Closure> compare(std::size_t target, const Candidate& candidate) {
    const std::vector<PlacedShape> query =
        around(scene_, candidate.query, options_.query_keyframes);
    search_.set_points(query, field_);
    SearchWindow window;
    window.middle = inverse(scene_.poses[target]) * scene_.poses[candidate.query];
    window.sigma_m = candidate.sigma.metres + 0.05;
    window.sigma_rad = candidate.sigma.radians + 0.01;
    window.reach_m = options_.window_sigmas * window.sigma_m;
    window.reach_rad = std::min(kPi, options_.window_sigmas * window.sigma_rad);
    const auto best = search_.best(field_, window, options_.least_score - 0.1);
    if (!best || best->score < options_.least_score) return std::nullopt;
    const auto rival = search_.best(field_, window, best->with_prior - options_.rival_margin,
                                    &best->pose, options_.rival_m, options_.rival_rad);
    if (rival) return std::nullopt;
    if (has_likeness(target, candidate.query, *best, window)) return std::nullopt;
    return refine(target, candidate.query, query, *best);
  }

  /// The surroundings of the target as they were seen before the query was taken.
  void survey_surroundings(std::size_t target, std::size_t query) {
    const std::size_t half = static_cast<std::size_t>(options_.query_keyframes / 2);
    const std::size_t limit = std::max(target + 1, query > half ? query - half : 0);
    const std::size_t end = way_end(scene_, target, options_.surroundings_m, limit);
    if (end == surroundings_end_) return;
    surroundings_end_ = end;
    FieldOptions wide = options_.grid;
    wide.most_reach_m += options_.surroundings_m;
    const std::size_t begin = way_begin(scene_, target, options_.surroundings_m);
    surroundings_.build(shapes_of(scene_, target, begin, end), true, wide);
  }

  /// Whether the surroundings repeat themselves at a distance that the window does not exclude:
  /// then the place may as well be one that was never seen before.
  bool has_likeness(std::size_t target, std::size_t query, const SearchPeak& peak,
                    const SearchWindow& window) {
    if (window.reach_m < options_.rival_m) return false;
    survey_surroundings(target, query);
    SearchWindow around_it = window;
    around_it.middle = peak.pose;
    around_it.reach_m = std::min(options_.surroundings_m, 2.0 * window.reach_m);
    around_it.most_cost = 0.0;
    return search_
        .best(surroundings_, around_it, peak.score - options_.likeness_margin, &peak.pose,
              options_.rival_m, options_.rival_rad)
        .has_value();
  }

  std::optional<Closure> refine(std::size_t target, std::size_t query,
                                std::span<const PlacedShape> shapes, const SearchPeak& peak) {
    std::vector<SurfacePoint> points;
    for (const PlacedShape& s : shapes) {
      const RigidTransform carry_by(s.frame_from_shape);
      for (const SurfacePoint& p : s.shape->points) points.push_back(carry(carry_by, p));
    }
    PosePrior prior{peak.pose, Matrix3d::Zero()};
    prior.information.diagonal() << 25.0, 25.0, 100.0;
    const Alignment fit =
        align(points, map_, prior, peak.pose, scene_.keyframes[query].beam_sigma_m, alignment_);
    if (!explains(points, fit.target_from_source)) return std::nullopt;
    const Matrix2d across = fit.information.topLeftCorner<2, 2>();
    const Eigen::SelfAdjointEigenSolver<Matrix2d> stiffness(across);
    if (!(stiffness.eigenvalues()(0) > 0.0) ||
        stiffness.eigenvalues()(0) < options_.least_stiffness * stiffness.eigenvalues()(1)) {
      return std::nullopt;
    }
    if (!is_near(peak.pose, fit.target_from_source, 0.4, 0.15)) return std::nullopt;
    if (!fit.information.allFinite() || fit.information(2, 2) <= 0.0) return std::nullopt;
    Matrix3d covariance =
        (fit.information + Vector3d(1.0, 1.0, 1.0).asDiagonal().toDenseMatrix()).inverse();
    covariance.diagonal().array() +=
        Vector3d(options_.closure_sigma_m, options_.closure_sigma_m, options_.closure_sigma_rad)
            .array()
            .square();
    return Closure{target, query, fit.target_from_source, covariance.inverse(), peak.score};
  }

  /// Whether enough points lie on walls, and few where beams had passed.
  bool explains(std::span<const SurfacePoint> points, const Pose2& target_from_query) const {
    const RigidTransform carry_by(target_from_query);
    const std::uint8_t unseen = field_.at(0, -1, -1);
    int hits = 0;
    int passed = 0;
    for (const SurfacePoint& p : points) {
      const Vector2d point = carry_by.point(p.point.cast<double>());
      const std::uint8_t value = field_.at(0, field_.column(point.x()), field_.row(point.y()));
      hits += value >= 128;
      passed += value < unseen / 2;
    }
    return hits >= options_.least_hits * static_cast<double>(points.size()) &&
           passed <= options_.most_contradiction * (hits + passed);
  }

  const LoopScene& scene_;
  const LoopOptions& options_;
  const AlignmentOptions& alignment_;
  EvidenceField field_;
  EvidenceField surroundings_;        // of the target, where they were asked for
  std::size_t surroundings_end_ = 0;  // of their keyframes; 0: there are none yet
  SurfaceMap map_;
  CorrelativeSearch search_;
};

/// A target near enough to a query to be compared with it.
struct Offer {
  std::size_t target = 0;  // place in the list
  double distance = 0.0;
  RelativeSigma sigma;

  double cost() const { return distance + sigma.metres; }
};

/// Of one query's offers the nearest of each pass, by target.
std::vector<Offer> nearest_of_passes(std::vector<Offer> offers) {
  constexpr std::size_t kSamePass = 3;  // targets
  std::stable_sort(offers.begin(), offers.end(),
                   [](const Offer& a, const Offer& b) { return a.target < b.target; });
  std::vector<Offer> kept;
  std::size_t last = 0;
  for (const Offer& offer : offers) {
    const bool same_pass = !kept.empty() && offer.target - last <= kSamePass;
    last = offer.target;
    if (!same_pass) {
      kept.push_back(offer);
    } else if (offer.distance < kept.back().distance) {
      kept.back() = offer;
    }
  }
  return kept;
}

/// Finds which targets a query may show: those of the passes that are nearest and known best.
class OfferSearch {
 public:
  OfferSearch(const LoopScene& scene, std::span<const std::size_t> targets,
              const LoopOptions& options)
      : scene_(scene), targets_(targets), options_(options), drift_(scene.drift, scene.poses) {}

  std::vector<Offer> of(std::size_t query) {
    std::size_t wanted = count_near(query);
    const std::size_t stride = static_cast<std::size_t>(std::max(1, options_.target_stride));
    std::vector<Offer> offers;
    if (wanted == 0) return offers;
    drift_.begin(query);
    while (wanted > 0) {
      const auto reached = drift_.next(scene_.limit_m);
      if (!reached) break;
      if (reached->node % stride != 0 || !is_near(query, reached->node)) continue;
      --wanted;
      const double apart_m = distance(query, reached->node);
      if (apart_m > options_.sight_m + options_.window_sigmas * reached->sigma.metres) continue;
      offers.push_back({reached->node / stride, apart_m, reached->sigma});
      if (is_enough(offers, reached->sigma.metres)) break;
    }
    std::vector<Offer> best = nearest_of_passes(std::move(offers));
    std::stable_sort(best.begin(), best.end(),
                     [](const Offer& a, const Offer& b) { return a.cost() < b.cost(); });
    if (best.size() > most()) best.resize(most());
    return best;
  }

 private:
  std::size_t most() const { return static_cast<std::size_t>(std::max(1, options_.most_targets)); }

  double distance(std::size_t a, std::size_t b) const {
    return (scene_.poses[a].translation() - scene_.poses[b].translation()).norm();
  }

  bool is_near(std::size_t query, std::size_t target) const {
    return target + static_cast<std::size_t>(options_.least_apart) <= query &&
           distance(query, target) <= options_.sight_m + options_.window_sigmas * scene_.limit_m;
  }

  std::size_t count_near(std::size_t query) const {
    return static_cast<std::size_t>(std::count_if(
        targets_.begin(), targets_.end(), [&](std::size_t t) { return is_near(query, t); }));
  }

  /// Those not yet reached are hardly known better than `metres`: hardly one of them costs less.
  bool is_enough(const std::vector<Offer>& offers, double metres) const {
    if (offers.size() < most()) return false;
    const std::vector<Offer> passes = nearest_of_passes(offers);
    const auto cheaper = std::count_if(passes.begin(), passes.end(),
                                       [&](const Offer& offer) { return offer.cost() <= metres; });
    return static_cast<std::size_t>(cheaper) >= most();
  }

  const LoopScene& scene_;
  std::span<const std::size_t> targets_;
  const LoopOptions& options_;
  DriftSearch drift_;
};

/// What is to be compared, as lists by target.
std::vector<std::vector<Candidate>> choose_pairs(const LoopScene& scene,
                                                 std::span<const std::size_t> targets,
                                                 std::span<const Closure> known,
                                                 const LoopOptions& options, int threads) {
  const std::size_t stride = static_cast<std::size_t>(std::max(1, options.query_stride));
  std::vector<std::vector<Offer>> by_query((scene.poses.size() + stride - 1) / stride);
  share_out(by_query.size(), threads, [&] {
    return [&, search = OfferSearch(scene, targets, options)](std::size_t i) mutable {
      by_query[i] = search.of(i * stride);
    };
  });
  const KnownClosures closures(known);
  std::vector<std::vector<Candidate>> out(targets.size());
  for (std::size_t i = 0; i < by_query.size(); ++i) {
    for (const Offer& offer : by_query[i]) {
      if (closures.hold(targets[offer.target], i * stride, options)) continue;
      out[offer.target].push_back({i * stride, offer.sigma});
    }
  }
  return out;
}

}  // namespace

std::vector<Closure> search_loops(const LoopScene& scene, std::span<const Closure> known,
                                  const LoopOptions& options, const AlignmentOptions& alignment,
                                  int threads) {
  std::vector<std::size_t> targets;
  const std::size_t stride = static_cast<std::size_t>(std::max(1, options.target_stride));
  for (std::size_t t = 0; t < scene.keyframes.size(); t += stride) targets.push_back(t);
  const auto pairs = choose_pairs(scene, targets, known, options, threads);
  std::vector<std::vector<Closure>> found(targets.size());
  share_out(targets.size(), threads, [&] {
    return [&, search = TargetSearch(scene, options, alignment)](std::size_t t) mutable {
      found[t] = search.search(targets[t], pairs[t]);
    };
  });
  std::vector<Closure> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace adit
