#include "adit/refinement/classification.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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
ByPlace other_shares(const RefinementOptions& options) {
  return {options.long_ratio, 1.0 - options.long_ratio};
}

/// How long the way is on which that may be (m). A beam that went farther behind than the wall is
/// away makes it longer: a pose close by a wall must not make all that is behind it likely.
double stretch_of(const BeamResidual& beam) { return std::max(beam.range, 0.5 * beam.measured); }

}  // namespace

double log_other(std::span<const BeamResidual> beams, const RefinementOptions& options) {
  LogProduct product;
  const ByPlace shares = other_shares(options);
  for (const BeamResidual& beam : beams) {
    if (!beam.has_return) continue;
    product.multiply(of(beam, shares) / stretch_of(beam) * beam.measured);
  }
  return product.log();
}

void BeamClassifier::classify(std::span<const BeamResidual> beams,
                              std::span<const double> variances, const RefinementOptions& options) {
  find_ratios(beams, variances, options);
  run_chain(options);
  for (std::size_t k = 0; k < beams.size(); ++k) {
    if (!beams[k].has_return) on_wall_[static_cast<Eigen::Index>(k)] = 0.0;
  }
}

/// The densities of a return, from the wall against something else.
void BeamClassifier::find_ratios(std::span<const BeamResidual> beams,
                                 std::span<const double> variances,
                                 const RefinementOptions& options) {
  size_ = beams.size();
  const auto size = static_cast<Eigen::Index>(size_);
  if (ratio_.size() < size) {  // grows only: the buffers of the longest scan stay
    ratio_.resize(size);
    on_wall_.resize(size);
    other_.resize(size);
    peak_.resize(size);
  }
  ByPlace peaks_per_m = other_shares(options);
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
    if (beams[static_cast<std::size_t>(k)].is_beyond) ratio_[k] *= options.beyond_ratio;
    if (!beams[static_cast<std::size_t>(k)].has_return) ratio_[k] = 1.0;
  }
}

/// Forward and backward pass over unnormalised probabilities, scaled now and then: products alone
/// depend on the beam before.
void BeamClassifier::run_chain(const RefinementOptions& options) {
  constexpr Eigen::Index kScaleEvery = 8;
  const auto size = static_cast<Eigen::Index>(size_);
  const double leave = options.clutter_begin_ratio;
  const double back = options.clutter_end_ratio;
  LogProduct evidence;
  double wall = back / (leave + back);
  double other = 1.0 - wall;
  for (Eigen::Index k = 0; k < size; ++k) {
    wall *= ratio_[k];
    if (k % kScaleEvery == 0) {
      const double sum = wall + other;
      evidence.multiply(sum);
      wall /= sum;
      other /= sum;
    }
    on_wall_[k] = wall;
    other_[k] = other;
    const double stays = wall * (1.0 - leave) + other * back;
    other = wall * leave + other * (1.0 - back);
    wall = stays;
  }
  evidence.multiply(wall + other);
  log_evidence_ = evidence.log();
  double wall_ahead = 1.0;  // likelihood of the beams after this one, by its class
  double other_ahead = 1.0;
  for (Eigen::Index k = size; k-- > 0;) {
    on_wall_[k] *= wall_ahead;
    other_[k] *= other_ahead;
    const double seen = ratio_[k] * wall_ahead;
    wall_ahead = (1.0 - leave) * seen + leave * other_ahead;
    other_ahead = back * seen + (1.0 - back) * other_ahead;
    if (k % kScaleEvery == 0) {
      const double scale = 1.0 / (wall_ahead + other_ahead);
      wall_ahead *= scale;
      other_ahead *= scale;
    }
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
