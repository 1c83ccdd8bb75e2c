#include "adit/extraction/noise_estimate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kAssumedSigma = 0.03;   // only to find breakpoints
constexpr double kGrazing = 0.15;        // rad
constexpr std::size_t kShortWindow = 8;  // points
constexpr double kLongWindow = 4.0;      // m
constexpr std::size_t kLongWindowPoints = 15;
constexpr std::size_t kLeastWindows = 6;
constexpr double kQuantile = 0.3;
// The 30 % quantile of chi-square with six degrees of freedom, over six.
constexpr double kQuantileOfStraight = 3.8276 / 6.0;

double quantile(std::vector<double> values, double q) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

void ScatterEstimator::add(const LaserScan& scan) {
  ScannerModel model;
  model.range_sigma_m = kAssumedSigma;
  model.quantisation_m = 0.0;
  model.max_range_m = scan.max_range;
  points_.build(scan, model, 0.0, kGrazing);
  for (const ScanPoints::Piece& piece : points_.pieces()) {
    add_short_windows(piece);
    add_long_windows(piece);
  }
}

/// Along a straight wall 1/r is linear in the beam's unit vector: a regression on exact bearings,
/// which noise larger than the spacing of the points does not bias.
void ScatterEstimator::add_short_windows(const ScanPoints::Piece& piece) {
  for (std::size_t i = piece.begin; i + kShortWindow <= piece.end; i += kShortWindow) {
    Matrix2d normal = Matrix2d::Zero();
    Vector2d right = Vector2d::Zero();
    double whole = 0.0;
    const double r = points_.range(i + kShortWindow / 2);
    for (std::size_t k = i; k < i + kShortWindow; ++k) {
      const Vector2d beam = points_.beam(k);
      const double scaled = r * r / points_.range(k);  // residuals become metres of range
      normal += beam * beam.transpose();
      right += beam * scaled;
      whole += scaled * scaled;
    }
    const double squared_error = whole - right.dot(normal.inverse() * right);
    beam_variances_.push_back(std::max(0.0, squared_error) / (kShortWindow - 2));
  }
}

void ScatterEstimator::add_long_windows(const ScanPoints::Piece& piece) {
  std::size_t begin = piece.begin;
  for (std::size_t i = piece.begin; i < piece.end; ++i) {
    if ((points_.point(i) - points_.point(begin)).norm() < kLongWindow) continue;
    if (i - begin >= kLongWindowPoints) {
      const Moments m = points_.moments(begin, i);
      const LineFit fit = fit_line(m);
      const double cosine = cross(fit.direction, fit.centroid.normalized());
      long_windows_.push_back({fit.squared_error / (m.n - 2.0), cosine * cosine});
    }
    begin = i;
  }
}

std::optional<ScatterEstimate> ScatterEstimator::estimate() const {
  if (beam_variances_.size() < kLeastWindows) return std::nullopt;
  ScatterEstimate result;
  result.windows = static_cast<int>(beam_variances_.size());
  const double variance = quantile(beam_variances_, kQuantile) / kQuantileOfStraight;
  result.beam_sigma_m = std::sqrt(variance);
  if (long_windows_.size() < kLeastWindows) return result;
  std::vector<double> excess;
  for (const LongWindow& w : long_windows_) {
    excess.push_back(w.across_variance - variance * w.cos2);
  }
  const double rough = quantile(std::move(excess), 0.5);
  if (rough > 0.25 * variance) result.roughness_m = std::sqrt(rough);
  return result;
}

}  // namespace adit
