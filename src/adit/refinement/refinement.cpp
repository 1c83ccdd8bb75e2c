#include "adit/refinement/refinement.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "adit/information/beam.hpp"
#include "adit/refinement/corner_zone.hpp"

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

// After so many steps they are shortened; at the end one of so many sigmas is still accepted.
constexpr int kFullSteps = 5;
constexpr double kAcceptedLength = 2.0;

// Less likely than this to have met the wall: the beam is left out.
constexpr double kLeastProbability = 0.01;

// Of the walls' offsets, where what they say of the pose is weighed, for walls that are smoother
// than the process that they are taken for. One whose correlation is Gaussian has 0.94 times that
// process' amplitude at long waves, which place a pose across a drift, and up to 1.29 times at
// waves of 3 to 5 times its length, which bends show; this lies between.
constexpr double kSmoothWalls = 1.03;

// Of odometry's errors in the two halves of a sweep. Wheels slip and scales are off for longer than
// a sweep lasts, but not only.
constexpr double kHalvesCorrelation = 1.0 / 3.0;

/// The gradient over the pose and, on the move, over the correction of the sweep's motion.
template <int N>
Eigen::Matrix<double, N, 1> parameters_gradient(const BeamResidual& beam, const RigidTransform& map,
                                                const SweepCorrection& correction) {
  if constexpr (N == 3) {
    return beam.gradient;
  } else {
    const Vector2d across = beam.gradient.head<2>();
    const Vector3d in_vehicle(across.dot(map.axis_x), across.dot(map.axis_y), beam.gradient.z());
    const std::array<double, 2> share = correction.shares(beam.tau);
    Eigen::Matrix<double, 9, 1> gradient;
    gradient << beam.gradient, share[0] * in_vehicle, share[1] * in_vehicle;
    return gradient;
  }
}

/// How the first three parameters follow the others where these are free.
Eigen::Matrix<double, 3, 6> gain_of(const NormalEquations<9>& all) {
  return all.information.topRightCorner<3, 6>() *
         all.information.bottomRightCorner<6, 6>().inverse();
}

/// A part of the equations on the first three parameters, the others having followed by `gain`.
NormalEquations<3> marginal(const NormalEquations<9>& part,
                            const Eigen::Matrix<double, 3, 6>& gain) {
  const Eigen::Matrix<double, 3, 6> left =
      part.information.topRightCorner<3, 6>() - gain * part.information.bottomRightCorner<6, 6>();
  NormalEquations<3> out;
  out.information = part.information.topLeftCorner<3, 3>() -
                    gain * part.information.bottomLeftCorner<6, 3>() - left * gain.transpose();
  out.score = part.score.head<3>() - gain * part.score.tail<6>();
  out.chi_square = part.chi_square;
  return out;
}

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

/// Which of two walls a beam met.
WallDoubt doubt_of(const RefinementInput& input, const Matrix3d& spread) {
  return {spread, input.map_error.sigma_m(), input.map_error.distortion_ratio,
          input.scanner.beam_sigma_m()};
}

/// Dead reckoning's word on the correction. What is known is the covariance C of the whole sweep's
/// mean motion. Between an error that is steady and a random walk lie halves whose errors are
/// correlated, by r: each then has 2 C / (1 + r), and the two the information
/// [1, -r; -r, 1] / (2 - 2 r) times C's inverse.
void add_motion_prior(const SweepPrior& motion, const SweepCorrection& correction,
                      NormalEquations<9>& sum) {
  const Matrix3d own = motion.covariance.inverse() / (2.0 - 2.0 * kHalvesCorrelation);
  const Matrix3d other = -kHalvesCorrelation * own;
  const Vector3d first = correction.halves[0].vector();
  const Vector3d second = correction.halves[1].vector();
  sum.information.block<3, 3>(3, 3) += own;
  sum.information.block<3, 3>(6, 6) += own;
  sum.information.block<3, 3>(3, 6) += other;
  sum.information.block<3, 3>(6, 3) += other;
  sum.score.segment<3>(3) -= own * first + other * second;
  sum.score.segment<3>(6) -= other * first + own * second;
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
  std::size_t stride = 1 + input.scan.ranges.size() / kCoarseBeams;
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
  return fit_;
}

void Refiner::count_beams() {
  const BeamSummary summary = classifier_.summary(residuals_.beams());
  fit_.counts = summary.counts;
  fit_.counts.unmapped = residuals_.unmapped();
  fit_.log_evidence = classifier_.log_evidence();
  fit_.expected_log_evidence = summary.expected_log_evidence;
}

std::span<const int> Refiner::worst_walls(std::size_t most) {
  constexpr double kFewBeamsOff = 3.0;
  off_wall_.clear();
  const std::span<const BeamResidual> beams = residuals_.beams();
  for (std::size_t k = 0; k < beams.size(); ++k) {
    if (!beams[k].has_return) continue;
    const int wall = beams[k].wall;
    auto known = std::find_if(off_wall_.begin(), off_wall_.end(),
                              [&](const auto& entry) { return entry.first == wall; });
    if (known == off_wall_.end()) known = off_wall_.insert(known, {wall, 0.0});
    known->second += 1.0 - classifier_.on_wall()[k];
  }
  std::sort(off_wall_.begin(), off_wall_.end(), [](const auto& a, const auto& b) {
    return a.second != b.second ? a.second > b.second : a.first < b.first;
  });
  worst_walls_.clear();
  for (const auto& [wall, beams_off] : off_wall_) {
    if (worst_walls_.size() < most && beams_off > kFewBeamsOff) worst_walls_.push_back(wall);
  }
  return worst_walls_;
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
  return classifier_.log_evidence() + log_other(residuals_.beams(), options) +
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
    offset_[k] *= kSmoothWalls;
  }
  spread_share_ = share / std::max<double>(1.0, static_cast<double>(beams.size()));
  classifier_.classify(beams, spread_, options);
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

/// The normal equations if every beam's error were its own.
template <int N>
NormalEquations<N> Refiner::white_equations() const {
  const std::span<const BeamResidual> beams = residuals_.beams();
  const RigidTransform map_from_vehicle(fit_.pose);
  NormalEquations<N> white;
  for (std::size_t k = 0; k < beams.size(); ++k) {
    const double probability = classifier_.on_wall()[k];
    if (probability < kLeastProbability) continue;
    const auto gradient = parameters_gradient<N>(beams[k], map_from_vehicle, fit_.correction);
    white.add(gradient, beams[k].residual, probability / noise_[k]);
  }
  white.mirror();
  return white;
}

Matrix3d Refiner::white_information(const RefinementInput& input) const {
  if (!input.motion) return white_equations<3>().information;
  NormalEquations<9> white = white_equations<9>();
  add_motion_prior(*input.motion, fit_.correction, white);
  return marginal(white, gain_of(white)).information;
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

/// The beams are judged ever more strictly, but no faster than the steps settle.
bool Refiner::is_last(double length, const RefinementOptions& options) {
  const bool settled = spread_share_ < kNegligibleSpread || spread_share_ > 0.5 * last_share_;
  last_share_ = spread_share_;
  if (fit_.iterations == options.max_iterations) return length < kAcceptedLength;
  return length < options.step_tolerance && settled;
}

}  // namespace adit
