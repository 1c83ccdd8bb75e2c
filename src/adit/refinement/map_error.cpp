#include "adit/refinement/map_error.hpp"

#include <algorithm>
#include <cmath>

#include "adit/information/beam.hpp"

namespace adit {
namespace {

constexpr double kLeastProbability = 0.5;
constexpr double kFar = 5.0;            // m; pairs of cells farther away count ever less
constexpr double kSameDirection = 0.9;  // cosine between the normals of one stretch

// The classifier takes the largest offsets for clutter: a normal distribution that is cut off at
// 2.5 sigma has lost this part of its variance.
constexpr double kCutTails = 1.2;

}  // namespace

void FirstMapError::add(std::span<const BeamResidual> beams, const ScannerModel& scanner) {
  constexpr double kMostOff = 0.6;           // m; farther from its wall a return is another thing's
  constexpr double kSigmaOfMedian = 1.4826;  // of absolute values that are normal
  across_.clear();
  double noise = 0.0;
  for (const BeamResidual& beam : beams) {
    const double cosine = 1.0 / beam.stretch;
    const double across = std::abs(beam.residual * cosine);
    if (!beam.has_return || across > kMostOff) continue;
    across_.push_back(across);
    noise += beam_variance(scanner, beam.range, cosine, 0.0) * cosine * cosine;
  }
  if (across_.empty()) return;
  const auto middle = across_.begin() + static_cast<std::ptrdiff_t>(across_.size() / 2);
  std::nth_element(across_.begin(), middle, across_.end());
  const double sigma = kSigmaOfMedian * *middle;
  variances_ += std::max(0.0, sigma * sigma - noise / static_cast<double>(across_.size()));
  ++scans_;
}

MapErrorEstimator::MapErrorEstimator(const MapErrorOptions& options) : options_(options) {
  settle();
}

void MapErrorEstimator::add(std::span<const BeamResidual> beams, std::span<const double> on_wall,
                            const ScannerModel& scanner, const Matrix3d& covariance) {
  cell_ = Cell{};
  run_length_ = 0;
  normal_ = Vector2d::Zero();
  seen_ = 0.0;
  for (std::size_t k = 0; k < beams.size(); ++k) {
    if (on_wall[k] < kLeastProbability) continue;
    const BeamResidual& beam = beams[k];
    const bool bends = beam.normal.dot(normal_) < kSameDirection;
    const double along = (beam.hit - cell_begin_).norm();
    if (bends || along > kCell) {
      close_cell(covariance);
      if (bends || along > 2.0 * kCell) run_length_ = 0;
      cell_.along_m = run_length_ > 0 ? run_[(run_length_ - 1) % kLags].along_m + along : 0.0;
      cell_begin_ = beam.hit;
      normal_ = beam.normal;
    }
    add_beam(beam, on_wall[k], scanner);
  }
  close_cell(covariance);
  forget(seen_);
  settle();
}

void MapErrorEstimator::add_beam(const BeamResidual& beam, double probability,
                                 const ScannerModel& scanner) {
  const double cosine = 1.0 / beam.stretch;
  const double stretch_squared = beam.stretch * beam.stretch;
  const double weight = probability * stretch_squared /
                        beam_variance_stretched(scanner, beam.range, stretch_squared, 0.0);
  const double across = beam.residual * cosine;
  cell_.weight += weight;
  cell_.residual += weight * across;
  cell_.squared += weight * across * across;
  cell_.gradient += weight * cosine * beam.gradient;
  cell_.beams += 1.0;
  cell_.range += beam.range;
}

void MapErrorEstimator::close_cell(const Matrix3d& covariance) {
  if (!(cell_.weight > 0.0)) return;
  cell_.residual /= cell_.weight;
  cell_.gradient /= cell_.weight;
  cell_.range /= cell_.beams;
  if (cell_.beams > 1.5) {
    // Scatter about the cell's mean has one degree of freedom less; the noise is worth one a beam.
    const double scatter = cell_.squared - cell_.weight * cell_.residual * cell_.residual;
    within_ += (scatter - (cell_.beams - 1.0)) / cell_.weight * cell_.beams;
    within_count_ += cell_.beams - 1.0;
  }
  const Vector3d carried = covariance * cell_.gradient;
  const auto product = [&](const Cell& other) {
    return cell_.residual * other.residual + carried.dot(other.gradient);
  };
  products_[0] += product(cell_) - 1.0 / cell_.weight;
  counts_[0] += 1.0;
  seen_ += 1.0;
  const std::size_t most = std::min(run_length_, kLags - 1);
  for (std::size_t back = 1; back <= most; ++back) {
    const Cell& other = run_[(run_length_ - back) % kLags];
    // Where beams end far apart, cells do as well.
    const double apart = cell_.along_m - other.along_m;
    const auto lag = static_cast<std::size_t>(apart / kCell);
    if (lag >= kLags) break;
    const double covariance_seen = product(other);
    metres_[lag] += apart;
    products_[lag] += covariance_seen;
    counts_[lag] += 1.0;
    if (lag == 1) growth_.add(cell_.range * other.range, covariance_seen, 1.0);
  }
  run_[run_length_ % kLags] = cell_;
  ++run_length_;
  cell_ = Cell{};
}

/// What was seen long ago counts less.
void MapErrorEstimator::forget(double cells) {
  const double kept = std::exp(-cells * kCell / options_.memory_metres);
  for (double& product : products_) product *= kept;
  for (double& count : counts_) count *= kept;
  for (double& metres : metres_) metres *= kept;
  growth_.forget(kept);
  within_ *= kept;
  within_count_ *= kept;
}

/// Variance and length of the process whose autocovariance was seen, with what was stated as so
/// many metres of wall.
void MapErrorEstimator::settle() {
  // Neighbouring cells hold the variance that walls share: extrapolated to no distance at all.
  const double total = std::max(0.0, covariance_at(0));
  const double shared = std::clamp(shared_covariance(), 0.0, total);
  const double prior = options_.prior_metres / kCell;
  const double within = std::max(0.0, within_ / (within_count_ + prior));
  const Growth growth = this->growth();
  const double bent = growth.growing_share() * kCutTails * shared;  // at the mean of the ranges
  error_.length_m = correlation_length(shared);
  error_.distortion_ratio = std::sqrt(bent / growth.mean_ranges());
  error_.offset_sigma_m = std::sqrt(kCutTails * shared - bent);
  error_.roughness_sigma_m = std::sqrt(total - shared + within);
}

/// The pairs that were seen, and beside them as many as were stated that speak for no growth.
MapErrorEstimator::Growth MapErrorEstimator::growth() const {
  const double prior = std::max(1.0, options_.prior_metres / kCell);
  const double mean = growth_.weight > 0.0 ? growth_.y / growth_.weight : 0.0;
  Growth growth = growth_;
  growth.add(0.0, mean, 0.5 * prior);
  growth.add(2.0 * kFar * kFar, mean, 0.5 * prior);
  return growth;
}

void MapErrorEstimator::Growth::add(double range_product, double residual_product, double times) {
  const double nearness = 1.0 / (1.0 + range_product / (kFar * kFar));
  const double counted = times * nearness * nearness;
  pairs += times;
  ranges += times * range_product;
  weight += counted;
  x += counted * range_product;
  xx += counted * range_product * range_product;
  y += counted * residual_product;
  xy += counted * range_product * residual_product;
}

void MapErrorEstimator::Growth::forget(double kept) {
  for (double* sum : {&pairs, &ranges, &weight, &x, &xx, &y, &xy}) *sum *= kept;
}

double MapErrorEstimator::Growth::growing_share() const {
  constexpr double kMost = 0.9;
  const double determinant = weight * xx - x * x;
  if (!(determinant > 0.0)) return 0.0;
  const double growing = (weight * xy - x * y) / determinant * mean_ranges();
  const double steady = (xx * y - x * xy) / determinant;
  if (!(growing > 0.0)) return 0.0;
  return std::min(kMost, growing / (growing + std::max(0.0, steady)));
}

/// The autocovariance extrapolated to no distance from the first two that were seen (m²).
double MapErrorEstimator::shared_covariance() const {
  std::size_t second = 2;
  while (second + 1 < kLags && is_unseen(second)) ++second;
  const double fall =
      (covariance_at(1) - covariance_at(second)) / (distance_at(second) - distance_at(1));
  return covariance_at(1) + fall * distance_at(1);
}

/// Whether hardly any cells lie so far apart, as where all beams end as far apart as two cells.
bool MapErrorEstimator::is_unseen(std::size_t lag) const {
  return counts_[lag] < 0.05 * counts_[1];
}

/// Mean distance of the cells whose products a lag holds (m).
double MapErrorEstimator::distance_at(std::size_t lag) const {
  const double prior = options_.prior_metres / kCell;
  const double stated = kCell * static_cast<double>(lag);
  return (metres_[lag] + prior * stated) / (counts_[lag] + prior);
}

/// Autocovariance of the walls' offsets at about so many cells' distance (m²).
double MapErrorEstimator::covariance_at(std::size_t lag) const {
  const double prior = options_.prior_metres / kCell;
  const double metres = kCell * static_cast<double>(lag);
  const double share =
      lag == 0 ? 1.0 : (1.0 - options_.roughness_share) * std::exp(-metres / options_.length_m);
  const double stated = options_.sigma_m * options_.sigma_m * share;
  return (products_[lag] + prior * stated) / (counts_[lag] + prior);
}

/// Where the autocovariance first falls to 1/e of its start (m).
double MapErrorEstimator::correlation_length(double shared) const {
  const double level = shared / std::exp(1.0);
  double last = shared;
  double last_metres = 0.0;
  for (std::size_t lag = 1; lag < kLags; ++lag) {
    if (is_unseen(lag)) continue;
    const double here = covariance_at(lag);
    const double metres = distance_at(lag);
    if (here < level) {
      return last_metres + (metres - last_metres) * (last - level) / (last - here);
    }
    last = here;
    last_metres = metres;
  }
  return kCell * static_cast<double>(kLags);
}

}  // namespace adit
