#include "adit/refinement/refinement.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "adit/information/beam.hpp"
#include "adit/refinement/corner_zone.hpp"
#include "adit/refinement/sweep_equations.hpp"

namespace adit {
namespace {

// No scanner is better than a millimetre, whatever a configuration says (m²).
constexpr double kLeastVariance = 1e-6;

// So many beams tell poses apart that lie a hand's breadth from each other.
constexpr std::size_t kEnoughBeams = 100;

// Where the doubt about the pose is less than this part of a residual's variance, on average, it no
// longer sways which beams count; of a step's doubt this part is left for the next, and as much as
// this part of the step: beams that are held for clutter because the pose is off make it too short.
constexpr double kNegligibleSpread = 0.2;
constexpr double kKeptSpread = 0.02;
constexpr double kLeftOfStep = 0.4;

// The first steps look at so many beams, until they are shorter than so many sigmas.
constexpr std::size_t kCoarseBeams = 250;
constexpr double kCoarseLength = 2.0;
constexpr int kMostCoarse = 3;

// A start no farther off than this needs no leading (one sigma; m, rad).
constexpr double kCloseMetres = 0.03;
constexpr double kCloseTurn = radians(0.3);

// A step that is so many times longer than the options allow may be the last all the same: over so
// short a way the map looks the same but for a beam or two at an edge.
constexpr double kSmoothLength = 3.0;
constexpr double kSmoothMetres = 0.02;
constexpr double kSmoothTurn = radians(0.2);

// After so many steps they are shortened; at the end one of so many sigmas is still accepted.
constexpr int kFullSteps = 5;
constexpr double kAcceptedLength = 2.0;

/// Adds what a run of beams on a wall says to what the wall has said before.
template <int N>
void add_share(int wall, const NormalEquations<N>& equations, std::vector<WallShareOf<N>>& shares) {
  const auto known = std::find_if(shares.begin(), shares.end(),
                                  [&](const WallShareOf<N>& share) { return share.wall == wall; });
  if (known != shares.end()) {
    known->equations += equations;
  } else {
    shares.push_back({wall, equations});
  }
}

bool is_close(const Matrix3d& covariance) {
  return covariance.topLeftCorner<2, 2>().trace() < kCloseMetres * kCloseMetres &&
         covariance(2, 2) < kCloseTurn * kCloseTurn;
}

/// Which of two walls a beam met.
WallDoubt doubt_of(const RefinementInput& input, const Matrix3d& spread) {
  return {spread, input.map_error.sigma_m(), input.map_error.distortion_ratio,
          input.scanner.beam_sigma_m()};
}

}  // namespace

const ScanFit& Refiner::refine(const RefinementInput& input, const PoseWithCovariance& prior,
                               const PoseWithCovariance& start, const RefinementOptions& options) {
  fit_ = ScanFit{};
  next_ = start.pose;
  next_correction_ = SweepCorrection{};
  const SweepPath path = input.motion ? input.motion->path : SweepPath{};
  Matrix3d spread = start.covariance;
  next_correction_.middle_s = path.begin_s + 0.5 * path.span_s;
  last_share_ = std::numeric_limits<double>::infinity();
  residuals_.set_scan(input.scan, input.scanner, input.missing_wall);
  // A few of the beams lead near the pose; all of them find it.
  std::size_t stride = is_close(start.covariance) ? 1 : 1 + input.scan.ranges.size() / kCoarseBeams;
  while (!fit_.converged && fit_.iterations < options.max_iterations) {
    ++fit_.iterations;
    fit_.pose = next_;
    fit_.correction = next_correction_;
    residuals_.compute(input.map, fit_.pose, path, fit_.correction, options, stride,
                       doubt_of(input, spread));
    weigh(input, spread, options);
    if (input.motion) {
      combine_moving(input.map_error, *input.motion);
    } else {
      combine_standing(input.map_error);
    }
    const double length = step(prior, input.motion.has_value(), options, spread);
    const bool is_coarse = stride > 1;
    if (is_coarse && (length < kCoarseLength || fit_.iterations >= kMostCoarse)) stride = 1;
    fit_.converged = !is_coarse && is_last(length, options);
  }
  fit_.white_information = white_information(input);
  count_beams();
  fit_.log_likelihood = log_likelihood(options);
  if (fit_.converged) take_last_step(input.motion.has_value());
  return fit_;
}

Pose2 Refiner::most_likely(const RefinementInput& input, const PoseWithCovariance& prior,
                           std::span<const Pose2> poses, const Matrix3d& spread,
                           const RefinementOptions& options) {
  const Matrix3d prior_information = prior.covariance.inverse();
  const SweepPath path = input.motion ? input.motion->path : SweepPath{};
  residuals_.set_scan(input.scan, input.scanner, input.missing_wall);
  Pose2 best = prior.pose;
  double most = -std::numeric_limits<double>::infinity();
  const std::size_t stride = 1 + input.scan.ranges.size() / kEnoughBeams;
  for (const Pose2& pose : poses) {
    residuals_.compute(input.map, pose, path, SweepCorrection{}, options, stride,
                       doubt_of(input, spread));
    weigh(input, spread, options);
    const Vector3d off = difference(prior.pose, pose);
    const double likelihood = log_likelihood(options) - 0.5 * off.dot(prior_information * off);
    if (likelihood <= most) continue;
    most = likelihood;
    best = pose;
  }
  return best;
}

/// Of the returns at the last pose looked at, against what no pose changes.
double Refiner::log_likelihood(const RefinementOptions& options) const {
  return classifier_.log_evidence() + log_other(residuals_.beams(), options.priors) +
         residuals_.log_unmapped();
}

/// The variance of each residual, and which beams met the wall.
void Refiner::weigh(const RefinementInput& input, const Matrix3d& spread,
                    const RefinementOptions& options) {
  const MapError& map_error = input.map_error;
  const std::span<const BeamResidual> beams = residuals_.beams();
  noise_.resize(beams.size());
  spread_.resize(beams.size());
  offset_.resize(beams.size());
  double share = 0.0;
  for (std::size_t k = 0; k < beams.size(); ++k) {
    const BeamResidual& beam = beams[k];
    const double stretch_squared = beam.stretch * beam.stretch;
    noise_[k] =
        std::max(kLeastVariance, beam_variance_stretched(input.scanner, beam.range, stretch_squared,
                                                         map_error.roughness_sigma_m)) +
        beam.wall_variance;
    offset_[k] = beam.stretch * map_error.offset_sigma_at(beam.range);
    const double known = noise_[k] + offset_[k] * offset_[k];
    const double doubt = beam.gradient.dot(spread * beam.gradient);
    spread_[k] = known + doubt;
    share += doubt / known;
    const double rounding = corner_sigma(input.map, beam, map_error, options) * beam.stretch;
    noise_[k] += rounding * rounding;
  }
  spread_share_ = share / std::max<double>(1.0, static_cast<double>(beams.size()));
  classifier_.classify(beams, spread_, options.priors);
}

/// The normal equations of all beams on walls, and each wall's part in them.
template <int N>
void Refiner::accumulate(const MapError& map_error, std::vector<WallShareOf<N>>& shares,
                         NormalEquations<N>& shared) {
  const std::span<const BeamResidual> beams = residuals_.beams();
  const RigidTransform map_from_vehicle(fit_.pose);
  OffsetWhitener<N> whitener(map_error);
  WallShareOf<N> current;
  shares.clear();
  const auto close_wall = [&] {
    if (current.wall < 0) return;
    current.equations.mirror();
    shared += current.equations;
    add_share(current.wall, current.equations, shares);
  };
  for (std::size_t k = 0; k < beams.size(); ++k) {
    const double probability = classifier_.on_wall()[k];
    if (probability < kLeastProbability) continue;
    const BeamResidual& beam = beams[k];
    if (beam.wall != current.wall) {
      close_wall();
      current = {beam.wall, {}};
    }
    const auto gradient = parameters_gradient<N>(beam, map_from_vehicle, fit_.correction);
    const double variance = noise_[k] / probability;
    whitener.move_to(beam.hit, beam.normal);
    whitener.add(beam.residual, gradient, offset_[k], variance, current.equations);
  }
  close_wall();
}

/// What the scan says of a vehicle at rest.
void Refiner::combine_standing(const MapError& map_error) {
  NormalEquations<3> shared;
  accumulate<3>(map_error, shares_, shared);
  take(shared);
}

/// What it says of the pose of a vehicle on the move, the sweep's motion being free.
void Refiner::combine_moving(const MapError& map_error, const SweepPrior& motion) {
  NormalEquations<9> shared;
  accumulate<9>(map_error, moving_shares_, shared);
  add_motion_prior(motion, fit_.correction, shared);
  const Eigen::Matrix<double, 3, 6> gain = gain_of(shared);
  take(marginal(shared, gain));
  shares_.clear();
  for (const WallShareOf<9>& share : moving_shares_) {
    shares_.push_back({share.wall, marginal(share.equations, gain)});
  }
  correction_information_ = shared.information.bottomRows<6>();
  correction_score_ = shared.score.tail<6>();
}

void Refiner::take(const NormalEquations<3>& shared) {
  fit_.information = shared.information;
  fit_.score = shared.score;
  fit_.chi_square = shared.chi_square;
}

/// A Gauss-Newton step to the pose that scan and prior make most likely; its length in sigmas.
double Refiner::step(const PoseWithCovariance& prior, bool moving, const RefinementOptions& options,
                     Matrix3d& spread) {
  const Matrix3d prior_information = prior.covariance.inverse();
  const Matrix3d covariance = (fit_.information + prior_information).inverse();
  Vector3d move = covariance * (fit_.score + prior_information * difference(fit_.pose, prior.pose));
  const double too_long = std::max(
      {1.0, move.head<2>().norm() / options.max_step_m, std::abs(move.z()) / options.max_step_rad});
  move /= too_long;
  // Beams that change sides at an edge make full steps swing to and fro.
  if (fit_.iterations > kFullSteps) move *= 0.6;
  next_ = {fit_.pose.x + move.x(), fit_.pose.y + move.y(), wrap_angle(fit_.pose.theta + move.z())};
  if (moving) {
    const Eigen::Matrix<double, 6, 1> more =
        correction_information_.rightCols<6>().inverse() *
        (correction_score_ - correction_information_.leftCols<3>() * move);
    next_correction_ = fit_.correction;
    for (int half = 0; half < 2; ++half) {
      Twist2& twist = next_correction_.halves[static_cast<std::size_t>(half)];
      twist = Twist2::from_vector(twist.vector() + more.segment<3>(3 * half));
    }
  }
  const double length = std::sqrt(move.dot((fit_.information + prior_information) * move));
  spread = covariance + kKeptSpread * spread + kLeftOfStep * kLeftOfStep * move * move.transpose();
  return too_long > 1.0 ? std::numeric_limits<double>::infinity() : length;
}

/// Whether the last step was short enough to be taken as linear.
bool Refiner::is_smooth(double length, const RefinementOptions& options) const {
  const Vector3d move = difference(fit_.pose, next_);
  return length < kSmoothLength * options.step_tolerance && move.head<2>().norm() < kSmoothMetres &&
         std::abs(move.z()) < kSmoothTurn;
}

/// The beams are judged ever more strictly, but no faster than the steps settle.
bool Refiner::is_last(double length, const RefinementOptions& options) {
  const bool settled = spread_share_ < kNegligibleSpread || spread_share_ > 0.5 * last_share_;
  last_share_ = spread_share_;
  if (fit_.iterations == options.max_iterations) {
    return length < kAcceptedLength * options.step_tolerance || is_smooth(length, options);
  }
  return settled && (length < options.step_tolerance || is_smooth(length, options));
}

}  // namespace adit
