#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "adit/refinement/beam_residuals.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// How the walls differ from the map's lines, across them.
///
/// An offset that neighbouring stretches of wall share, a stationary process along the wall whose
/// correlation falls to 1/e within `length_m` (Ornstein-Uhlenbeck), and a roughness that no two
/// beams share. A plan also bends: the farther a wall, the less it lies where those near the
/// vehicle let expect it.
struct MapError {
  double offset_sigma_m = 0.0;
  double length_m = 1.5;
  double roughness_sigma_m = 0.0;
  double distortion_ratio = 0.0;  ///< of the offset, per metre between vehicle and wall (m/m)

  /// Of the offset of a wall that is seen from so far (m).
  double offset_sigma_at(double range) const {
    const double bent = distortion_ratio * range;
    return std::sqrt(offset_sigma_m * offset_sigma_m + bent * bent);
  }
  /// Of a single point (m).
  double sigma_m() const {
    return std::sqrt(offset_sigma_m * offset_sigma_m + roughness_sigma_m * roughness_sigma_m);
  }
};

/// What is believed of the map before the first scan, and how fast it is learnt.
struct MapErrorOptions {
  double sigma_m = 0.10;
  bool is_stated = true;  ///< where it is not, the first scans choose; see `FirstMapError`
  double length_m = 1.5;
  double roughness_share = 0.02;
  double prior_metres = 60.0;
  double memory_metres = 3000.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field(
        "sigma_m", self.sigma_m,
        "how far the plan may lie from the mine: bends, whole walls, on each axis, one sigma (m); "
        "0 for an exact plan. What it errs over a metre or two is learnt, from here on");
    field("length_m", self.length_m,
          "way along a wall after which its offset has become another, to 1/e (m)");
    field("roughness_share", self.roughness_share,
          "share of the variance that no two beams share, before it is learnt");
    field(
        "prior_metres", self.prior_metres,
        "so many metres of wall must be seen before the residuals count more than what is stated");
    field("memory_metres", self.memory_metres,
          "so many metres of wall are remembered: what a few dozen scans see (m)");
  }
};

/// A first guess of the map's error, from scans that were fitted with another.
///
/// What is learnt from residuals depends on which beams are taken for walls, and that on the error
/// believed; from a start that is far off it would not come back. The median of all residuals that
/// may still be the wall's does not ask.
class FirstMapError {
 public:
  bool is_open() const { return scans_ < kScans; }
  /// Forgets the scans but keeps the memory.
  void reset() {
    scans_ = 0;
    variances_ = 0.0;
  }
  void add(std::span<const BeamResidual> beams, const ScannerModel& scanner);
  /// Mean over the scans so far (m), generous: from too much, learning finds down by itself.
  double sigma_m() const { return scans_ > 0 ? kGenerous * std::sqrt(variances_ / scans_) : 0.0; }

 private:
  static constexpr double kGenerous = 1.7;
  static constexpr int kScans = 5;

  int scans_ = 0;
  double variances_ = 0.0;
  std::vector<double> across_;  // absolute residuals across the wall, of one scan
};

/// Learns the map's error from the residuals of the fits, scan by scan.
///
/// Residuals across the wall are averaged over short cells; products of cells of one wall at
/// growing distance are the autocovariance of the walls' offsets, free of the beams' noise. What
/// the fit of the pose took out of the residuals is put back by the fit's covariance. How the
/// products grow with the ranges of both cells tells the plan's distortion.
class MapErrorEstimator {
 public:
  explicit MapErrorEstimator(const MapErrorOptions& options = {});

  /// The beams of a fit, each with its probability to have met the wall, and the covariance of the
  /// fitted pose.
  void add(std::span<const BeamResidual> beams, std::span<const double> on_wall,
           const ScannerModel& scanner, const Matrix3d& covariance);

  const MapError& error() const { return error_; }

 private:
  static constexpr double kCell = 0.25;     // m of wall
  static constexpr std::size_t kLags = 16;  // cells: four metres

  /// Mean residual across a short piece of wall.
  struct Cell {
    double weight = 0.0;    // sum of 1 / variance (1/m²)
    double residual = 0.0;  // weighted sums ...
    double squared = 0.0;
    Vector3d gradient = Vector3d::Zero();
    double beams = 0.0;
    double range = 0.0;
    double along_m = 0.0;  // where it begins, from the run's first
  };
  /// A line through products of neighbouring cells over the products of their ranges.
  struct Growth {
    double pairs = 0.0;
    double ranges = 0.0;  // product of the two cells' (m²), summed over the pairs
    // Weighted sums, x being the ranges and y the product of the residuals.
    double weight = 0.0;
    double x = 0.0;
    double xx = 0.0;
    double y = 0.0;
    double xy = 0.0;

    void add(double range_product, double residual_product, double times);
    void forget(double kept);
    double mean_ranges() const { return ranges / pairs; }
    /// How much of the mean product grows with the ranges.
    double growing_share() const;
  };
  void add_beam(const BeamResidual& beam, double probability, const ScannerModel& scanner);
  void close_cell(const Matrix3d& covariance);
  void forget(double cells);
  void settle();
  double covariance_at(std::size_t lag) const;
  double distance_at(std::size_t lag) const;
  bool is_unseen(std::size_t lag) const;
  double shared_covariance() const;
  double correlation_length(double shared) const;
  Growth growth() const;

  MapErrorOptions options_;
  MapError error_;
  Cell cell_;
  Vector2d cell_begin_ = Vector2d::Zero();
  Vector2d normal_ = Vector2d::Zero();
  std::array<Cell, kLags> run_;  // closed cells of this stretch of wall, a ring
  std::size_t run_length_ = 0;
  double seen_ = 0.0;  // cells
  std::array<double, kLags> products_{};
  std::array<double, kLags> counts_{};
  std::array<double, kLags> metres_{};  // that those pairs lie apart
  Growth growth_;
  double within_ = 0.0;  // scatter within cells beyond the noise, weighted by beams
  double within_count_ = 0.0;
};

}  // namespace adit
