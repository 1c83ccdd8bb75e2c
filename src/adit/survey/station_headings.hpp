#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adit/survey/station_field.hpp"
#include "adit/survey/station_sight.hpp"

namespace adit {

/// How headings at known positions are sought.
struct HeadingOptions {
  double coarse_step_rad = radians(2.0);
  double coarse_blur_m = 0.3;
  double fine_blur_m = 0.15;
  double point_spacing_m = 0.2;
  double reach_m = 40.0;
  int neighbours = 8;
  int candidates = 8;
  int sweeps = 12;
  double given_within_rad = radians(15.0);
  double through_m = 0.5;
  double against = 4.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("coarse_step_rad", self.coarse_step_rad, "step of the search round the circle (rad)");
    field("coarse_blur_m", self.coarse_blur_m,
          "blur of what a station saw, for the search round the circle (m)");
    field("fine_blur_m", self.fine_blur_m, "the same for the last step (m)");
    field("point_spacing_m", self.point_spacing_m, "points of a station are this far apart (m)");
    field("reach_m", self.reach_m, "stations farther apart are not compared (m)");
    field("neighbours", self.neighbours, "stations with which each is compared");
    field("candidates", self.candidates,
          "headings of the first station from which the others are found in turn");
    field("sweeps", self.sweeps, "most rounds over all stations with the fine step");
    field("given_within_rad", self.given_within_rad,
          "a heading that is given is looked for no farther than this from there (rad)");
    field("through_m", self.through_m,
          "a beam that ends farther than this behind what another station saw contradicts it (m)");
    field("against", self.against,
          "the share of such surfaces, times this, lessens the logarithm of the agreement");
  }
};

/// What was seen from one position.
struct StationView {
  Vector2d position = Vector2d::Zero();
  std::optional<double> heading;     ///< rad, where it is known roughly
  std::vector<StationPoint> points;  ///< in the vehicle's frame
  StationSight sight;                ///< the same frame; may be empty
  double sure_range_m = 1e9;         ///< points farther than this may be roof or floor
};

/// The heading of one station.
struct StationHeading {
  double heading_rad = 0.0;
  double agreement = 0.0;  ///< from 0 to 1, with what the others saw
  double sigma_rad = 0.0;
  double contradiction = 0.0;  ///< share of surfaces that were seen through, from 0 to 1
};

/// Headings of all stations such that what they saw agrees, in the frame of the positions.
///
/// A heading is one number where the position is known, so the circle can be searched whole. The
/// first station's heading has nothing to be compared with but pairs: for each of its headings the
/// best of each neighbour; the best of those grow station by station over all, and the one under
/// which all agree best is kept, which is refined with sharper fields in turn until still.
std::vector<StationHeading> find_headings(std::span<const StationView> stations,
                                          const HeadingOptions& options = {});

/// The turn that carries `points` best onto the field of another scan from the same position (rad).
double find_turn(std::span<const StationPoint> points, StationField& field, double from, double to,
                 double step);

}  // namespace adit
