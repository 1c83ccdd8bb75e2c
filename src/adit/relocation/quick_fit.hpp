#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/places/wall_field.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// Moves a scan onto the walls nearest to its returns, in microseconds: what stands between, or
/// lies hidden, it does not see. Thousands of poses are thus brought near enough to where they
/// belong that their likelihoods can be compared.
class QuickFit {
 public:
  /// Takes about so many of the returns of a scan, evenly spread.
  void set_scan(const LaserScan& scan, const ScannerModel& scanner, std::size_t beams);

  struct Result {
    Pose2 map_from_laser;
    float agreement = 0.0F;  ///< share of the returns that lie at a wall
  };

  /// A few steps from a pose that may be off by half a metre and a few degrees.
  Result approach(const WallField& field, const Pose2& map_from_laser) const;

  /// Some more, from one that is nearly there.
  Result settle(const WallField& field, const Pose2& map_from_laser) const;

  /// The share of the returns before which a wall stands.
  float through(const WallField& field, const Pose2& map_from_laser) const;

  /// A pose relative to the field's origin (m), with the cosine and sine of its heading.
  struct Placed {
    float x = 0.0F;
    float y = 0.0F;
    float cosine = 1.0F;
    float sine = 0.0F;
  };

  /// The share of the returns that lie at a wall, each by how near it is (one sigma, m).
  float agreement(const WallField& field, const Placed& at, float sigma_m) const;

  /// What each code of how far off counts (one sigma, m).
  using OffWeights = std::array<float, 256>;
  static OffWeights off_weights(float sigma_m);

  /// By how near the middles of their squares are: rougher, and several times as fast in a large
  /// plan.
  float rough_agreement(const WallField& field, const Placed& at, const OffWeights& weights) const;

  /// Some returns (laser axes, m), in lanes that are worked on side by side: twice as many as the
  /// widest vectors hold, for compilers unroll shorter loops before they make vectors of them.
  static constexpr std::size_t kLanes = 16;
  using Lanes = std::array<float, kLanes>;
  struct Returns {
    Lanes x{};
    Lanes y{};
    Lanes counts{};  ///< one for a return, none for what fills the last lanes
  };

 private:
  /// What is near to where: returns must lie so near to a wall to count (one sigma, m).
  Result fit(const WallField& field, const Pose2& map_from_laser,
             std::span<const float> sigmas) const;

  std::vector<Returns> returns_;
  std::size_t count_ = 0;
};

}  // namespace adit
