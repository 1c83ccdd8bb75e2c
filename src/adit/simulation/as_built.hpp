#pragma once

#include <cstdint>

#include "adit/simulation/world.hpp"

namespace adit {

/// How a mine differs from its plan. All zero: not at all.
struct AsBuiltOptions {
  double bend_m = 0.0;
  double reach_m = 8.0;
  double rough_m = 0.0;
  double rough_reach_m = 1.5;
  double missing_ratio = 0.0;
  double added_ratio = 0.0;
  double chains_ratio = 0.0;
  double chain_offset_m = 0.3;
  double distortion = 0.0;
  double distortion_reach_m = 100.0;
  double clearance_m = 1.2;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("bend_m", self.bend_m, "how far the plan is bent on each axis, one sigma (m)");
    field("reach_m", self.reach_m, "distance at which the bend's correlation falls to 1/e (m)");
    field("rough_m", self.rough_m, "roughness of the walls across their lines, one sigma (m)");
    field("rough_reach_m", self.rough_reach_m,
          "distance at which the roughness' correlation falls to 1/e (m)");
    field("missing_ratio", self.missing_ratio,
          "share of the plan's walls that the mine lacks, by length");
    field("added_ratio", self.added_ratio,
          "walls of the mine that the plan lacks, as a share of the plan's length");
    field("chains_ratio", self.chains_ratio,
          "share of the walls, by length, that stand off as a whole, from corner to corner");
    field("chain_offset_m", self.chain_offset_m,
          "how far these stand off across, to one side or the other (m)");
    field("distortion", self.distortion,
          "strain by which the whole plan is distorted slowly, RMS on each axis; 0.001 is 0.1 %");
    field("distortion_reach_m", self.distortion_reach_m,
          "distance at which the distortion's correlation falls to 1/e (m)");
    field("clearance_m", self.clearance_m,
          "no added or displaced wall comes nearer than this to the vehicle's way (m)");
  }
};

/// The mine that was built from a plan: `walls` differ as the options say, `plan` stays.
///
/// Walls are taken out (chains, or stretches of long ones), displaced (whole chains, joined to
/// their neighbours again) and added (stoppings, stubs, masonry at walls); then all is moved by the
/// sum of three `SmoothField`s: the bend, the roughness, and the distortion, whose sigma is
/// distortion * distortion_reach_m / √2, so that its strain has the RMS asked for. What shares an
/// end goes on sharing it. The path is moved by bend and distortion; people and clutter are not, so
/// that they are put in afterwards. Same options and seed: same bits; each part of the options
/// draws from a stream of its own.
World as_built(World planned, const AsBuiltOptions& options, std::uint64_t seed);

/// How far the mine lies from its plan over more than a few metres (m): per axis, one sigma. The
/// bend, the distortion, and the displaced chains with their share.
double long_plan_error(const AsBuiltOptions& options);

/// The same mine with a plan that lacks all within `radius` (m) of a place; walls are cut there.
World off_plan(World world, const Vector2d& place, double radius);

}  // namespace adit
