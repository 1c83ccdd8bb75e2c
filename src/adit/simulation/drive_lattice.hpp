#pragma once

#include <span>
#include <vector>

#include "adit/simulation/wall_buckets.hpp"

namespace adit {

/// A square lattice over a plan and its rim, and in each square the spot with the most room.
struct DriveLattice {
  struct Spot {
    Vector2d position;
    double room = 0.0;  ///< distance to the nearest wall (m), at most what is ample
    /// Whether rows and columns through it cross walls an odd number of times on the way out, in
    /// both senses: for each 1 for yes, -1 for no, 0 where the two senses disagree.
    int vote = 0;
  };

  Vector2d corner = Vector2d::Zero();  ///< lower left
  double pitch_m = 1.0;
  int columns = 0;
  int rows = 0;
  std::vector<Spot> spots;  ///< row by row
};

/// The pitch is as asked unless the plan is so large that it must be coarser.
DriveLattice lay_lattice(const WallBuckets& walls, double pitch_m, double ample_m);

}  // namespace adit
