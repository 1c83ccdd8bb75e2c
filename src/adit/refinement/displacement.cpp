#include "adit/refinement/displacement.hpp"

#include <algorithm>
#include <cmath>

#include "adit/information/beam.hpp"

namespace adit {
namespace {

constexpr double kOffTheWall = 0.5;   // probability of having met it, at most
constexpr double kLargestStep = 0.5;  // m between neighbours of one stretch, along the wall

/// Neighbouring returns that lie off one wall.
struct Stretch {
  int wall = -1;
  double count = 0.0;
  double sum = 0.0;  // of distances across the wall (m)
  double squares = 0.0;
  double variance = 0.0;  // sum of what noise and map allow (m²)
  Vector2d first = Vector2d::Zero();
  Vector2d last = Vector2d::Zero();

  double displacement(const DisplacementOptions& options) const {
    if (count < 3.0 || (last - first).norm() < options.least_length_m) return 0.0;
    const double mean = sum / count;
    const double scatter = squares / count - mean * mean;
    const double ratio = options.roughness_ratio;
    const bool is_wall = scatter < ratio * ratio * variance / count;
    return is_wall && std::abs(mean) < options.most_m ? std::abs(mean) : 0.0;
  }
};

}  // namespace

double largest_displacement(std::span<const BeamResidual> beams, std::span<const double> on_wall,
                            const ScannerModel& scanner, double map_sigma_m,
                            const DisplacementOptions& options) {
  double largest = 0.0;
  Stretch stretch;
  for (std::size_t k = 0; k < beams.size(); ++k) {
    const BeamResidual& beam = beams[k];
    if (!beam.has_return || on_wall[k] > kOffTheWall) continue;
    const double cosine = 1.0 / beam.stretch;
    const double across = beam.residual * cosine;
    const Vector2d along = perpendicular(beam.normal);
    const Vector2d foot = beam.hit + beam.residual * beam.direction.dot(along) * along;
    if (beam.wall != stretch.wall || (foot - stretch.last).norm() > kLargestStep) {
      largest = std::max(largest, stretch.displacement(options));
      stretch = Stretch{};
      stretch.wall = beam.wall;
      stretch.first = foot;
    }
    stretch.last = foot;
    stretch.count += 1.0;
    stretch.sum += across;
    stretch.squares += across * across;
    stretch.variance += beam_variance(scanner, beam.range, cosine, map_sigma_m) * cosine * cosine;
  }
  return std::max(largest, stretch.displacement(options));
}

}  // namespace adit
