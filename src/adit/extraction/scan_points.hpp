#pragma once

#include <cstddef>
#include <vector>

#include "adit/geometry/moments.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/returns.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// Noise of the points perpendicular to the wall that they lie on.
struct PointNoise {
  double beam_variance = 0.0;       ///< along the beam (m²)
  double roughness_variance = 0.0;  ///< of the wall itself (m²)
  double bearing_variance = 0.0;    ///< of the beam's bearing (rad²)

  /// Variance across a wall at squared range `range2`, met at incidence with squared cosine `cos2`.
  double across(double cos2, double range2) const {
    return beam_variance * cos2 + roughness_variance + bearing_variance * range2 * (1.0 - cos2);
  }
};

/// The returns of one scan as points of the laser's frame, counter-clockwise, cut into pieces at
/// occlusions, with prefix sums so that any stretch is fitted in O(1).
///
/// A full circle starts at a breakpoint, not at the first beam; where it has none it is `closed`
/// and starts at the farthest point, which lies in a corner.
class ScanPoints {
 public:
  /// Points farther apart than this have an opening between them, not drop-outs.
  static constexpr int kMostBeamsApart = 6;

  struct Piece {
    std::size_t begin = 0;  ///< first point
    std::size_t end = 0;    ///< one past the last
  };

  /// `grazing` is the smallest angle (rad) between beam and wall at which neighbours still join.
  void build(const LaserScan& scan, const ScannerModel& scanner, double roughness, double grazing);

  /// Starts a closed scan at another of its points.
  void restart_at(std::size_t point);

  std::size_t size() const { return x_.size(); }
  bool closed() const { return closed_; }
  const std::vector<Piece>& pieces() const { return pieces_; }
  const PointNoise& noise() const { return noise_; }
  double x(std::size_t i) const { return x_[i]; }
  double y(std::size_t i) const { return y_[i]; }
  double range(std::size_t i) const { return range_[i]; }
  Vector2d point(std::size_t i) const { return {x_[i], y_[i]}; }
  /// Unit vector of the beam.
  Vector2d beam(std::size_t i) const { return direction(beam_[i]); }
  /// Unit vector of the k-th beam in the counter-clockwise order of all beams, with or without
  /// return.
  Vector2d direction(int k) const {
    return {cos_[static_cast<std::size_t>(k)], sin_[static_cast<std::size_t>(k)]};
  }
  /// The range from which there are no returns (m).
  double no_return_from() const { return limits_.none_from_m; }
  /// Position of the beam in the counter-clockwise order of all beams.
  int beam_index(std::size_t i) const { return beam_[i]; }
  double beam_step() const { return step_; }
  /// How many beams point j comes after point i, counter-clockwise; 1 for neighbouring beams.
  int beams_between(std::size_t i, std::size_t j) const;
  int beam_count() const { return static_cast<int>(cos_.size()); }
  bool full_circle() const { return full_circle_; }

  /// Sums of the points [begin, end).
  Moments moments(std::size_t begin, std::size_t end) const { return sums_[end] - sums_[begin]; }

  /// Chi-square of the points [begin, end) about their own best line.
  double chi_square(std::size_t begin, std::size_t end) const;

  /// Whether that chi-square lies at most so many sigmas above what a straight wall would have.
  bool is_straight(std::size_t begin, std::size_t end, double sigmas) const;

 private:
  /// Squared distances of points from their line, the noise across it at their middle, and the
  /// squared distance of the line from the scanner.
  struct LineError {
    double squared = 0.0;
    double variance = 0.0;
    double foot2 = 0.0;
  };
  LineError line_error(std::size_t begin, std::size_t end) const;
  void prepare_beams(const LaserScan& scan);
  void collect(const LaserScan& scan, const ScannerModel& scanner);
  bool joined(std::size_t i, std::size_t j) const;
  void rotate(std::size_t first);
  void cut_pieces();
  void accumulate();

  double first_bearing_ = 0.0;
  ReturnLimits limits_;
  double step_ = 0.0;
  double spacing_per_metre_ = 0.0;  // of neighbouring points, at the grazing angle
  double reach_of_noise_ = 0.0;     // four sigma of the distance between two points (m)
  bool evenly_spaced_ = false;      // the beams whose cosines are kept
  bool full_circle_ = false;
  bool closed_ = false;
  PointNoise noise_;
  std::vector<double> cos_, sin_;
  std::vector<double> x_, y_, range_;
  std::vector<int> beam_;
  std::vector<Moments> sums_;
  std::vector<Piece> pieces_;
};

}  // namespace adit
