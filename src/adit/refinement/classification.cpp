#include "adit/refinement/classification.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "adit/refinement/beam_chain.hpp"

namespace adit {
namespace {

/// The logarithm of a product of many factors, with few logarithms.
class LogProduct {
 public:
  void multiply(double factor) {
    product_ *= factor;
    if (product_ > 1e100 || product_ < 1e-100) {
      log_ += std::log(product_);
      product_ = 1.0;
    }
  }
  double log() const { return log_ + std::log(product_); }

 private:
  double product_ = 1.0;
  double log_ = 0.0;
};

/// A value for returns before the wall and one for those behind it. Picked by index: chance decides
/// which, and no processor guesses a branch on it.
using ByPlace = std::array<double, 2>;

double of(const BeamResidual& beam, const ByPlace& values) {
  return values[static_cast<std::size_t>(beam.residual < 0.0 ? 1 : 0)];
}

/// The shares of returns from something else: anywhere before the wall, or, rarely, anywhere as far
/// behind it.
ByPlace other_shares(const BeamPriors& priors) {
  return {priors.long_ratio, 1.0 - priors.long_ratio};
}

/// How long the way is on which that may be (m). A beam that went farther behind than the wall is
/// away makes it longer: a pose close by a wall must not make all that is behind it likely.
double stretch_of(const BeamResidual& beam) { return std::max(beam.range, 0.5 * beam.measured); }

constexpr Eigen::Index kScaleEvery = 8;

}  // namespace

double log_other(std::span<const BeamResidual> beams, const BeamPriors& priors) {
  LogProduct product;
  const ByPlace shares = other_shares(priors);
  for (const BeamResidual& beam : beams) {
    if (!beam.has_return) continue;
    product.multiply(of(beam, shares) / stretch_of(beam) * beam.measured);
  }
  return product.log();
}

void BeamClassifier::classify(std::span<const BeamResidual> beams,
                              std::span<const double> variances, const BeamPriors& priors) {
  find_ratios(beams, variances, priors);
  run_chain(priors);
  for (std::size_t k = 0; k < beams.size(); ++k) {
    if (!beams[k].has_return) on_wall_[static_cast<Eigen::Index>(k)] = 0.0;
  }
}

/// The densities of a return, from the wall against something else.
void BeamClassifier::find_ratios(std::span<const BeamResidual> beams,
                                 std::span<const double> variances, const BeamPriors& priors) {
  size_ = beams.size();
  const auto size = static_cast<Eigen::Index>(size_);
  if (ratio_.size() < size) {  // grows only: the buffers of the longest scan stay
    ratio_.resize(size);
    beyond_.resize(size);
    on_wall_.resize(size);
    gone_.resize(size);
    other_.resize(size);
    peak_.resize(size);
  }
  ByPlace peaks_per_m = other_shares(priors);
  for (double& value : peaks_per_m) value = 1.0 / (value * std::sqrt(kTwoPi));
  for (Eigen::Index k = 0; k < size; ++k) {
    const BeamResidual& beam = beams[static_cast<std::size_t>(k)];
    ratio_[k] = -0.5 * beam.residual * beam.residual;
    peak_[k] = stretch_of(beam) * of(beam, peaks_per_m);
  }
  // The longest part of the work, over whole arrays.
  const Eigen::Map<const Eigen::ArrayXd> variance(variances.data(), size);
  auto peaks = peak_.head(size);
  auto ratios = ratio_.head(size);
  peaks /= variance.sqrt();
  ratios = (ratios / variance).max(-200.0).exp() * peaks;
  for (Eigen::Index k = 0; k < size; ++k) {
    const BeamResidual& beam = beams[static_cast<std::size_t>(k)];
    if (!beam.has_return) ratio_[k] = 1.0;
    // The residual is of one of both walls: the other is not what the beam met.
    beyond_[k] = beam.is_beyond || !beam.has_return ? ratio_[k] : 0.0;
    if (beam.is_beyond && beam.has_return) ratio_[k] = 0.0;
  }
}

/// Forward and backward pass over unnormalised probabilities, scaled now and then: products alone
/// depend on the beam before.
void BeamClassifier::run_chain(const BeamPriors& priors) {
  const auto size = static_cast<Eigen::Index>(size_);
  const Matrix3d next = transition(priors);
  Vector3d met = steady_state(priors);
  LogProduct evidence;
  for (Eigen::Index k = 0; k < size; ++k) {
    met[Met::kWall] *= ratio_[k];
    met[Met::kBeyond] *= beyond_[k];
    if (k % kScaleEvery == 0) {
      const double sum = met.sum();
      evidence.multiply(sum);
      met /= sum;
    }
    on_wall_[k] = met[Met::kWall];
    other_[k] = met[Met::kOther];
    gone_[k] = met[Met::kBeyond];
    met = next.transpose() * met;
  }
  evidence.multiply(met.sum());
  log_evidence_ = evidence.log();
  run_backward(next);
}

void BeamClassifier::run_backward(const Matrix3d& next) {
  const auto size = static_cast<Eigen::Index>(size_);
  Vector3d ahead = Vector3d::Ones();  // likelihood of the beams after this one, by what it met
  for (Eigen::Index k = size; k-- > 0;) {
    on_wall_[k] = on_wall_[k] * ahead[Met::kWall] + gone_[k] * ahead[Met::kBeyond];
    other_[k] *= ahead[Met::kOther];
    ahead[Met::kWall] *= ratio_[k];
    ahead[Met::kBeyond] *= beyond_[k];
    ahead = next * ahead;
    if (k % kScaleEvery == 0) ahead /= ahead.sum();
  }
  on_wall_.head(size) /= on_wall_.head(size) + other_.head(size);
}

BeamSummary BeamClassifier::summary(std::span<const BeamResidual> beams) const {
  const double mean_loss = std::exp(-0.5);  // of a normal residual
  BeamSummary summary;
  LogProduct expected;
  ByPlace elsewhere{};
  for (std::size_t k = 0; k < beams.size(); ++k) {
    if (!beams[k].has_return) {
      summary.counts.no_return += 1.0;
      continue;
    }
    const double weight = on_wall_[static_cast<Eigen::Index>(k)];
    summary.counts.mapped += 1.0;
    summary.counts.wall += weight;
    elsewhere[beams[k].residual < 0.0 ? 1 : 0] += 1.0 - weight;
    // Of the beams that would tell a wall from something else.
    const double ratio = mean_loss * peak_[static_cast<Eigen::Index>(k)];
    if (ratio > 1.0) expected.multiply(ratio);
  }
  summary.counts.behind = elsewhere[0];
  summary.counts.before = elsewhere[1];
  summary.expected_log_evidence = expected.log();
  return summary;
}

}  // namespace adit
