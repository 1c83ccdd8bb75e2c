#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// Where to look when a fit explains its scan badly.
struct SearchOptions {
  double poor_evidence_ratio = 0.6;
  double poor_evidence_per_behind = 7.0;
  double most_poor_evidence_ratio = 0.9;
  double poor_chi_square = 16.27;
  double reach_sigmas = 2.0;
  double least_reach_m = 0.2;
  double least_reach_rad = 0.05;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("poor_evidence_ratio", self.poor_evidence_ratio,
          "a fit is poor that explains less than this of what a scan of nothing but the map's "
          "walls would");
    field("poor_evidence_per_behind", self.poor_evidence_per_behind,
          "beside it, so many times the share of the returns that it puts behind the map's walls, "
          "...");
    field("most_poor_evidence_ratio", self.most_poor_evidence_ratio,
          "... but one that explains more than this is not poor");
    field("poor_chi_square", self.poor_chi_square,
          "poor is also one farther than this from the prediction; chi-square of three degrees of "
          "freedom "
          "at 1e-3");
    field("reach_sigmas", self.reach_sigmas,
          "other places are tried as far as so many sigmas of the prediction");
    field("least_reach_m", self.least_reach_m, "but no less far than this (m)");
    field("least_reach_rad", self.least_reach_rad, "and turned by no less than this (rad)");
  }
};

/// Poses around a prediction: up to five by five places, and three headings.
class PoseLattice {
 public:
  PoseLattice(const PoseWithCovariance& around, const SearchOptions& options);

  std::span<const Pose2> poses() const { return {poses_.data(), count_}; }
  /// How far a pose may lie from the nearest of the lattice.
  Matrix3d spread() const;

 private:
  static constexpr int kPlaces = 2;    // on either side, at most
  static constexpr int kHeadings = 1;  // on either side
  static constexpr std::size_t kPoses = (2 * kPlaces + 1) * (2 * kPlaces + 1) * (2 * kHeadings + 1);

  double step_m_ = 0.0;
  double step_rad_ = 0.0;
  std::size_t count_ = 0;
  std::array<Pose2, kPoses> poses_;
};

}  // namespace adit
