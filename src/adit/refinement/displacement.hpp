#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "adit/refinement/beam_residuals.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// When returns off a wall of the map look like that wall, drawn in another place.
struct DisplacementOptions {
  double least_length_m = 1.5;
  double most_m = 2.5;
  double roughness_ratio = 1.5;
  double kept_m = 14.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("least_length_m", self.least_length_m,
          "a shorter stretch parallel to a wall of the map may be anything that stands about (m)");
    field("most_m", self.most_m, "a stretch farther than this from the wall is another wall (m)");
    field("roughness_ratio", self.roughness_ratio,
          "a stretch that scatters by more than so many sigmas of walls and noise is no wall");
    field("kept_m", self.kept_m,
          "what was seen once counts for this way (m): the pose may follow the wall that is wrong, "
          "and not every scan shows it");
  }
};

/// How far (m) a stretch of returns lies from the wall of the map that it is parallel to, the
/// largest of all; 0 where nothing looks like a wall in the wrong place.
///
/// Either that wall is drawn wrong, or the pose is wrong by this and all others are: the scan alone
/// cannot tell.
double largest_displacement(std::span<const BeamResidual> beams, std::span<const double> on_wall,
                            const ScannerModel& scanner, double map_sigma_m,
                            const DisplacementOptions& options);

/// The largest displacement seen on the last `kept_m` of way, or a little more: the way is cut into
/// pieces, of which each keeps its largest.
class RecentDisplacement {
 public:
  /// The vehicle has gone on by so much (m).
  void drive(double way_m, const DisplacementOptions& options) {
    way_m_ += way_m;
    const double piece_m = options.kept_m / static_cast<double>(kPieces);
    while (way_m_ > piece_m) {
      newest_ = (newest_ + 1) % largest_.size();
      largest_[newest_] = 0.0;
      way_m_ = std::min(way_m_ - piece_m, options.kept_m + piece_m);  // older than all of it
    }
  }
  void see(double displacement) { largest_[newest_] = std::max(largest_[newest_], displacement); }
  double largest() const { return *std::max_element(largest_.begin(), largest_.end()); }
  void reset() { *this = RecentDisplacement{}; }

 private:
  static constexpr std::size_t kPieces = 32;
  std::array<double, kPieces + 1> largest_{};  // a ring; the oldest piece leaves as a whole
  std::size_t newest_ = 0;
  double way_m_ = 0.0;  // in the newest
};

}  // namespace adit
