#include "adit/relocation/relocator.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "adit/relocation/place_verdict.hpp"

namespace adit {
namespace {

// So many beams lead a fit near its pose.
constexpr std::size_t kLeadingBeams = 120;

// A fitted pose is off by no more than this (m).
constexpr double kFittedDoubt = 0.02;

// One that was fitted with few beams, once, by this (m).
constexpr double kCoarseDoubt = 0.08;

// So many poses elsewhere are fitted whatever their likelihood.
constexpr int kRivals = 4;

/// Every so many beams of a scan.
void thin(const LaserScan& scan, LaserScan& out) {
  const std::size_t stride = std::max<std::size_t>(1, scan.ranges.size() / kLeadingBeams);
  out = scan;
  out.ranges.clear();
  out.bearings.clear();
  out.bearing_step = scan.bearing_step * static_cast<double>(stride);
  for (std::size_t i = 0; i < scan.ranges.size(); i += stride) {
    out.ranges.push_back(scan.ranges[i]);
    if (!scan.bearings.empty()) out.bearings.push_back(scan.bearings[i]);
  }
}

/// A return where the map has nothing is one from behind its walls.
FitQuality quality_in_map(const ScanFit& fit) {
  FitQuality quality = quality_of(fit);
  if (quality.returns > 0.0) quality.behind_ratio += fit.counts.unmapped / quality.returns;
  return quality;
}

/// A map whose walls err by this part of what another's do.
MapError scaled(const MapError& error, double ratio) {
  return {ratio * error.offset_sigma_m, error.length_m, ratio * error.roughness_sigma_m,
          ratio * error.distortion_ratio};
}

/// The search's basin: how far a fit may be from where it began.
Matrix3d basin(double metres, double radians) {
  return Vector3d(metres, metres, radians).cwiseAbs2().asDiagonal();
}

}  // namespace

const RelocationResult& Relocator::locate(const RelocationQuery& query,
                                          const RelocationOptions& options,
                                          const LikelihoodOptions& likelihood,
                                          const RefinementOptions& refinement,
                                          const StatusOptions& status) {
  refinement_ = coarse_refinement_ = refinement;
  coarse_refinement_.same_place_m = options.same_place_m;
  coarse_refinement_.looks_beyond = false;
  likelihood_.set_walls(index_.walls());
  likelihood_.set_scan(query.scan, query.scanner, query.map_error, likelihood, refinement.priors);
  count_lines(query, options);
  const auto& [scan, scanner, map_error, motion, within] = query;
  look(query, search_.find(index_, scan, scanner, within, options), options, likelihood);
  result_.verdict = judge_place(result_, query, places(), options, status);
  const bool is_sure = result_.verdict == Status::ok || result_.verdict == Status::degraded;
  const bool is_settled = is_sure && result_.gap >= options.second_look_gap;
  if (is_settled || options.second_look_gap <= 0.0) return result_;
  const RelocationOptions more = widened(options);
  look(query, search_.find_again(index_, scan, scanner, within, more), more, likelihood);
  result_.verdict = judge_place(result_, query, places(), options, status);
  return result_;
}

/// Fits and weighs poses of the laser.
void Relocator::look(const RelocationQuery& query, std::span<const PlaceMatch> matches,
                     const RelocationOptions& options, const LikelihoodOptions& likelihood) {
  const Pose2 laser_from_vehicle = inverse(query.scan.vehicle_from_laser);
  hypotheses_.clear();
  for (const PlaceMatch& match : matches) {
    hypotheses_.push_back({match.map_from_laser * laser_from_vehicle, 0.0});
  }
  result_.poses.clear();
  result_.map_error = query.map_error;
  likelihood_.set_map_error(query.map_error);
  fit_coarsely(query, options);
  fit_all_points(query, options);
  result_.share_of_news = likelihood_.share_of_news();
  result_.gap = gap_to_others(options);
  weigh(options);
  examine_best(query, likelihood);
}

double Relocator::likelihood_at(const RelocationQuery& query, const Pose2& map_from_vehicle,
                                double doubt_m) {
  return likelihood_.at(map_, map_from_vehicle * query.scan.vehicle_from_laser, doubt_m);
}

const ScanFit& Relocator::fit(const RefinementInput& input, const Pose2& pose,
                              const RelocationOptions& options,
                              const RefinementOptions& refinement) {
  const PoseWithCovariance prior{pose, basin(options.basin_m, options.basin_rad)};
  const PoseWithCovariance start{pose, basin(options.start_m, options.doubt_rad)};
  return refiner_.refine(input, prior, start, refinement);
}

/// Keeps the most likely, none near a better one.
template <class Ranked>
static bool keep_best(std::vector<Ranked>& ranked, std::size_t most,
                      const RelocationOptions& options) {
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.log_likelihood > b.log_likelihood;
  });
  const std::size_t before = ranked.size();
  std::size_t kept = 0;
  std::size_t i = 0;
  for (; i < ranked.size() && kept < most; ++i) {
    const auto begin = ranked.begin();
    const bool known =
        std::any_of(begin, begin + static_cast<std::ptrdiff_t>(kept), [&](const Ranked& better) {
          return is_near(better.pose, ranked[i].pose, options.merge_m, options.merge_rad);
        });
    if (!known) ranked[kept++] = ranked[i];
  }
  ranked.resize(kept);
  return i < before;
}

/// Fits with some of the beams, ever fewer poses. In mines that are much alike it takes the right
/// error of the plan to tell them from each other.
void Relocator::fit_coarsely(const RelocationQuery& query, const RelocationOptions& options) {
  const auto count = [](int value) { return static_cast<std::size_t>(std::max(1, value)); };
  thin(query.scan, thinned_);
  const RefinementInput input{map_, thinned_, query.scanner, query.map_error, query.motion};
  for (Hypothesis& hypothesis : hypotheses_) {
    const ScanFit& fitted = fit(input, hypothesis.pose, options, coarse_refinement_);
    hypothesis = {fitted.pose, fitted.log_likelihood};
  }
  keep_best(hypotheses_, count(options.rated_again), options);
  rate_by_likeliest_error(query, kCoarseDoubt, options);
  result_.is_cut_off = keep_best(hypotheses_, count(options.fitted_again), options);
  drop_hopeless(options);
  narrow_down(query, options);
  rate_by_likeliest_error(query, kFittedDoubt, options);
  result_.is_cut_off |= keep_best(hypotheses_, count(options.refined), options);
}

/// Fits with ever smaller errors of the plan, down to the likeliest: at once with that, a fit that
/// is a little off would take the walls for something else that stands near them.
void Relocator::narrow_down(const RelocationQuery& query, const RelocationOptions& options) {
  constexpr double kLeast = 0.05;
  const double last = std::max(kLeast, error_ratio(result_.map_error, query.map_error));
  for (double ratio = 0.5; ratio > 1.01 * last; ratio *= 0.5) {
    fit_thinned(query, scaled(query.map_error, ratio), options);
  }
  fit_thinned(query, result_.map_error, options);
}

void Relocator::fit_thinned(const RelocationQuery& query, const MapError& error,
                            const RelocationOptions& options) {
  const RefinementInput input{map_, thinned_, query.scanner, error, query.motion};
  for (Hypothesis& hypothesis : hypotheses_) {
    hypothesis.pose = fit(input, hypothesis.pose, options, coarse_refinement_).pose;
  }
}

/// How likely each hypothesis is where the plan errs as much as suits it best; at the best of them,
/// that is how much it errs.
void Relocator::rate_by_likeliest_error(const RelocationQuery& query, double doubt_m,
                                        const RelocationOptions& options) {
  std::vector<double> ratios;
  const double least = std::max(0.01, options.least_map_ratio);
  for (double ratio = 1.0; ratio > 0.99 * least; ratio *= 0.5) {
    ratios.push_back(ratio);
  }
  likelihood_.set_map_error(query.map_error);
  double most = -std::numeric_limits<double>::infinity();
  for (Hypothesis& hypothesis : hypotheses_) {
    const auto best =
        likelihood_.best_at(map_, hypothesis.pose * query.scan.vehicle_from_laser, doubt_m, ratios);
    hypothesis.log_likelihood = best.log_likelihood;
    if (best.log_likelihood <= most) continue;
    most = best.log_likelihood;
    result_.map_error = scaled(query.map_error, best.error_ratio);
  }
}

/// Those that are too unlikely beside the best to become so by another fit; of those elsewhere a
/// few stay, for how unlikely they are counts. They come sorted.
void Relocator::drop_hopeless(const RelocationOptions& options) {
  if (hypotheses_.empty()) return;
  const Hypothesis best = hypotheses_.front();
  const double least = best.log_likelihood - options.unfitted_gap;
  int rivals = 0;
  std::erase_if(hypotheses_, [&](const Hypothesis& h) {
    const bool is_rival = !is_near(best.pose, h.pose, options.apart_m, options.apart_rad);
    rivals += is_rival;
    return h.log_likelihood < least && !(is_rival && rivals <= kRivals);
  });
}

/// The poses that have a chance, fitted with all points. How well the plan fits the scan at the
/// best of them says how much it errs here: where it hardly does, other poses cannot hide in its
/// error.
void Relocator::fit_all_points(const RelocationQuery& query, const RelocationOptions& options) {
  likelihood_.set_map_error(result_.map_error);
  drop_hopeless(options);
  take_fits(query, result_.map_error, options);
  if (result_.poses.empty()) return;
  hypotheses_.clear();
  for (const RankedPose& pose : result_.poses) {
    hypotheses_.push_back({pose.pose, pose.log_likelihood});
  }
  const double before = result_.map_error.sigma_m();
  rate_by_likeliest_error(query, kFittedDoubt, options);
  likelihood_.set_map_error(result_.map_error);
  if (result_.map_error.sigma_m() == before) return;
  take_fits(query, result_.map_error, options);
}

void Relocator::take_fits(const RelocationQuery& query, const MapError& error,
                          const RelocationOptions& options) {
  const RefinementInput input{map_, query.scan, query.scanner, error, query.motion};
  const Matrix3d confidence = basin(options.basin_m, options.basin_rad).inverse();
  result_.poses.clear();
  for (const Hypothesis& hypothesis : hypotheses_) {
    const ScanFit& fitted = fit(input, hypothesis.pose, options, refinement_);
    RankedPose ranked;
    ranked.pose = fitted.pose;
    ranked.covariance = (fitted.information + confidence).inverse();
    ranked.log_likelihood = likelihood_at(query, fitted.pose, kFittedDoubt);
    ranked.quality = quality_in_map(fitted);
    result_.poses.push_back(ranked);
  }
  const auto listed = static_cast<std::size_t>(std::max(1, options.listed));
  result_.is_cut_off |= keep_best(result_.poses, listed, options);
}

/// Weights from the likelihoods, tempered by what of them is news.
void Relocator::weigh(const RelocationOptions& options) {
  std::vector<RankedPose>& poses = result_.poses;
  if (poses.empty()) return;
  const double best = poses.front().log_likelihood;
  double sum = 0.0;
  for (RankedPose& pose : poses) {
    pose.weight = std::exp(likelihood_.share_of_news() * (pose.log_likelihood - best));
    sum += pose.weight;
  }
  const auto light = std::find_if(poses.begin(), poses.end(), [&](const RankedPose& pose) {
    return pose.weight < options.least_weight * sum;
  });
  poses.erase(light, poses.end());
  sum = 0.0;
  for (const RankedPose& pose : poses) sum += pose.weight;
  for (RankedPose& pose : poses) pose.weight /= sum;
}

double Relocator::gap_to_others(const RelocationOptions& options) const {
  double gap = options.hopeless_gap;
  for (const RankedPose& pose : result_.poses) {
    const RankedPose& best = result_.poses.front();
    if (is_near(best.pose, pose.pose, options.apart_m, options.apart_rad)) continue;
    const double less = best.log_likelihood - pose.log_likelihood;
    gap = std::min(gap, likelihood_.share_of_news() * less);
  }
  return gap;
}

/// How much shape the scan has.
void Relocator::count_lines(const RelocationQuery& query, const RelocationOptions& options) {
  const FeatureList& features =
      extractor_.extract(query.scan, query.scanner, options.corners.extraction);
  result_.lines = static_cast<int>(
      std::count_if(features.lines.begin(), features.lines.end(),
                    [&](const Line& line) { return line.length() >= options.line_m; }));
}

/// What becomes of the beams at the best pose.
void Relocator::examine_best(const RelocationQuery& query, const LikelihoodOptions& likelihood) {
  constexpr int kBeams = 360;
  result_.shares = {};
  if (result_.poses.empty()) return;
  LikelihoodOptions more = likelihood;
  more.beams = std::max(kBeams, likelihood.beams);
  all_beams_.set_scan(query.scan, query.scanner, result_.map_error, more, refinement_.priors);
  const Pose2 laser = result_.poses.front().pose * query.scan.vehicle_from_laser;
  result_.shares = all_beams_.shares_at(map_, laser, kFittedDoubt);
}

}  // namespace adit
