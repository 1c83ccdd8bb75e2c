#pragma once

#include <span>

#include "adit/refinement/beam_residuals.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// When returns off a wall of the map look like that wall, drawn in another place.
struct DisplacementOptions {
  double least_length_m = 1.5;
  double most_m = 2.5;
  double roughness_ratio = 1.5;
  double kept_m = 16.0;

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

/// The largest displacement of late.
class RecentDisplacement {
 public:
  /// After a scan that shows so much, so much way (m) after the last.
  double next(double displacement, double way_m, const DisplacementOptions& options) {
    since_m_ += way_m;
    if (displacement >= largest_ || since_m_ > options.kept_m) {
      largest_ = displacement;
      since_m_ = 0.0;
    }
    return largest_;
  }
  void reset() { *this = RecentDisplacement{}; }

 private:
  double largest_ = 0.0;
  double since_m_ = 0.0;
};

}  // namespace adit
