#include "adit/relocation/relocator.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "adit/relocation/fit_quality.hpp"

namespace adit {
namespace {

// So many beams lead a fit near its pose.
constexpr std::size_t kLeadingBeams = 120;

// A fitted pose is off by no more than this (m).
constexpr double kFittedDoubt = 0.02;

// One that was fitted with few beams, once, by this (m).
constexpr double kCoarseDoubt = 0.08;

// Before poses were fitted their likelihoods differ by so many times more.
constexpr double kUnfittedGaps = 3.0;

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
  return {ratio * error.offset_sigma_m, error.length_m, ratio * error.roughness_sigma_m};
}

bool is_near(const Pose2& a, const Pose2& b, double metres, double radians) {
  const Vector3d apart = difference(a, b);
  return apart.head<2>().norm() <= metres && std::abs(apart.z()) <= radians;
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
  result_.poses.clear();
  result_.verdict = Status::lost;
  refinement_ = refinement;
  result_.map_error = query.map_error;
  likelihood_.set_scan(query.scan, query.scanner, query.map_error, likelihood);
  rate_candidates(query, options);
  fit_coarsely(query, options);
  fit_all_points(query, options);
  weigh(options);
  result_.verdict = verdict(query.map_error, options, status);
  return result_;
}

double Relocator::likelihood_at(const RelocationQuery& query, const Pose2& map_from_vehicle,
                                double doubt_m) {
  return likelihood_.at(map_, map_from_vehicle * query.scan.vehicle_from_laser, doubt_m);
}

/// The poses whose views resemble the scan; those that agree most with the walls come first.
void Relocator::rate_candidates(const RelocationQuery& query, const RelocationOptions& options) {
  hypotheses_.clear();
  const Pose2 laser_from_vehicle = inverse(query.scan.vehicle_from_laser);
  for (const PlaceMatch& match :
       search_.find(index_, query.scan, query.scanner, query.within, options)) {
    hypotheses_.push_back({match.map_from_laser * laser_from_vehicle,
                           likelihood_.at(map_, match.map_from_laser, options.doubt_m)});
  }
}

const ScanFit& Relocator::fit(const RefinementInput& input, const Pose2& pose,
                              const RelocationOptions& options) {
  const PoseWithCovariance prior{pose, basin(options.basin_m, options.basin_rad)};
  const PoseWithCovariance start{pose, basin(options.start_m, options.doubt_rad)};
  return refiner_.refine(input, prior, start, refinement_);
}

/// Keeps the most likely, none near a better one.
template <class Ranked>
static void keep_best(std::vector<Ranked>& ranked, std::size_t most,
                      const RelocationOptions& options) {
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.log_likelihood > b.log_likelihood;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < ranked.size() && kept < most; ++i) {
    const auto begin = ranked.begin();
    const bool known =
        std::any_of(begin, begin + static_cast<std::ptrdiff_t>(kept), [&](const Ranked& better) {
          return is_near(better.pose, ranked[i].pose, options.merge_m, options.merge_rad);
        });
    if (!known) ranked[kept++] = ranked[i];
  }
  ranked.resize(kept);
}

/// Where a scan hardly shows how far along a drift it was taken, a pose that is a little off is an
/// unlikely one before it is fitted: agreement with the walls counts as well.
void Relocator::fit_coarsely(const RelocationQuery& query, const RelocationOptions& options) {
  const auto agreeing =
      std::min(hypotheses_.size(), static_cast<std::size_t>(std::max(0, options.agreeing)));
  std::vector<Hypothesis> chosen(hypotheses_.begin(),
                                 hypotheses_.begin() + static_cast<std::ptrdiff_t>(agreeing));
  drop_hopeless(options, kUnfittedGaps);
  std::stable_sort(hypotheses_.begin(), hypotheses_.end(), [](const auto& a, const auto& b) {
    return a.log_likelihood > b.log_likelihood;
  });
  const auto most = static_cast<std::size_t>(std::max(1, options.coarsely_refined));
  for (const Hypothesis& hypothesis : hypotheses_) {
    if (chosen.size() >= most) break;
    const bool has = std::any_of(chosen.begin(), chosen.end(), [&](const Hypothesis& other) {
      return other.pose.vector() == hypothesis.pose.vector();
    });
    if (!has) chosen.push_back(hypothesis);
  }
  hypotheses_ = std::move(chosen);
  thin(query.scan, thinned_);
  improve(query, kCoarseDoubt, options);
  keep_best(hypotheses_, static_cast<std::size_t>(std::max(1, options.again_refined)), options);
  drop_hopeless(options, 1.0);
  improve(query, kFittedDoubt, options);
  keep_best(hypotheses_, static_cast<std::size_t>(std::max(1, options.refined)), options);
  drop_hopeless(options, 1.0);
}

/// Those that are too unlikely beside the best to become so by another fit.
void Relocator::drop_hopeless(const RelocationOptions& options, double gaps) {
  double best = -std::numeric_limits<double>::infinity();
  for (const Hypothesis& hypothesis : hypotheses_) best = std::max(best, hypothesis.log_likelihood);
  const double least = best - gaps * options.hopeless_gap / likelihood_.share_of_news();
  std::erase_if(hypotheses_, [&](const Hypothesis& h) { return h.log_likelihood < least; });
}

/// Fits each hypothesis with some of the beams.
void Relocator::improve(const RelocationQuery& query, double doubt_m,
                        const RelocationOptions& options) {
  const RefinementInput input{map_, thinned_, query.scanner, query.map_error, query.motion};
  for (Hypothesis& hypothesis : hypotheses_) {
    const Pose2 fitted = fit(input, hypothesis.pose, options).pose;
    hypothesis = {fitted, likelihood_at(query, fitted, doubt_m)};
  }
}

/// The poses that have a chance, fitted with all points. How well the plan fits the scan at the
/// best of them says how much it errs here: where it hardly does, other poses cannot hide in its
/// error.
void Relocator::fit_all_points(const RelocationQuery& query, const RelocationOptions& options) {
  take_fits(query, query.map_error, options);
  if (result_.poses.empty()) return;
  const MapError error = likeliest_map_error(query, options);
  result_.map_error = error;
  likelihood_.set_map_error(error);
  hypotheses_.clear();
  for (const RankedPose& pose : result_.poses) {
    hypotheses_.push_back({pose.pose, likelihood_at(query, pose.pose, kFittedDoubt)});
  }
  drop_hopeless(options, 1.0);
  take_fits(query, error, options);
}

void Relocator::take_fits(const RelocationQuery& query, const MapError& error,
                          const RelocationOptions& options) {
  const RefinementInput input{map_, query.scan, query.scanner, error, query.motion};
  const Matrix3d confidence = basin(options.basin_m, options.basin_rad).inverse();
  result_.poses.clear();
  for (const Hypothesis& hypothesis : hypotheses_) {
    const ScanFit& fitted = fit(input, hypothesis.pose, options);
    RankedPose ranked;
    ranked.pose = fitted.pose;
    ranked.covariance = (fitted.information + confidence).inverse();
    ranked.log_likelihood = likelihood_at(query, fitted.pose, kFittedDoubt);
    ranked.quality = quality_in_map(fitted);
    result_.poses.push_back(ranked);
  }
  keep_best(result_.poses, static_cast<std::size_t>(std::max(1, options.listed)), options);
}

MapError Relocator::likeliest_map_error(const RelocationQuery& query,
                                        const RelocationOptions& options) {
  constexpr double kStep = 0.5;
  MapError likeliest = query.map_error;
  double most = -std::numeric_limits<double>::infinity();
  for (double ratio = 1.0; ratio > 0.99 * options.least_map_ratio; ratio *= kStep) {
    const MapError error = scaled(query.map_error, ratio);
    likelihood_.set_map_error(error);
    for (const RankedPose& pose : result_.poses) {
      const double likelihood = likelihood_at(query, pose.pose, kFittedDoubt);
      if (likelihood <= most) continue;
      most = likelihood;
      likeliest = error;
    }
  }
  return likeliest;
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

Status Relocator::verdict(const MapError& stated, const RelocationOptions& options,
                          const StatusOptions& status) const {
  if (result_.poses.empty()) return Status::lost;
  const RankedPose& best = result_.poses.front();
  if (best.quality.returns < status.fewest_returns || !explains(best.quality, status)) {
    return Status::lost;
  }
  double rivals = 0.0;
  for (const RankedPose& pose : result_.poses) {
    if (!is_near(best.pose, pose.pose, options.apart_m, options.apart_rad)) rivals += pose.weight;
  }
  if (rivals > options.rival_weight) return Status::ambiguous;
  const double error_ratio =
      stated.sigma_m() > 0.0 ? result_.map_error.sigma_m() / stated.sigma_m() : 0.0;
  const double asked = options.sure_evidence_ratio +
                       options.sure_evidence_per_behind * best.quality.behind_ratio +
                       options.sure_evidence_per_error * error_ratio;
  if (best.quality.evidence_ratio < asked) return Status::ambiguous;
  return open_direction(best.covariance, status) ? Status::degraded : Status::ok;
}

}  // namespace adit
