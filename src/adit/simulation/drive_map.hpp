#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adit/simulation/wall_buckets.hpp"

namespace adit {

/// Where in a plan a machine may drive.
struct DriveMapOptions {
  double clearance_m = 0.8;
  double ample_m = 3.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("clearance_m", self.clearance_m, "the machine's place keeps so far from walls (m)");
    field("ample_m", self.ample_m, "more room than this to a wall is no better (m)");
  }
};

/// Places along the openings of a plan and the straight pieces between them that a machine may
/// drive: each with the clearance to all walls, exactly.
///
/// A square lattice of the clearance's pitch is laid over the plan; the place of a square is the
/// one with the most room of 25, if it has the clearance. Neighbours (8) are linked where the piece
/// between them has it too. Which linked sets are openings: those with the most of `inside`, points
/// that are known to lie in openings, or, where none are given, those where rows and columns cross
/// walls an odd number of times on the way out; sets with less than a twentieth of the best's are
/// left out. What is linked with the lattice's rim is the rock around; where the openings leak into
/// it, only places with such a vote count.
class DriveMap {
 public:
  DriveMap() = default;
  explicit DriveMap(std::span<const Segment> walls, const DriveMapOptions& options = {},
                    std::span<const Vector2d> inside = {});

  /// Whether there is nowhere to drive.
  bool empty() const { return places_.empty(); }
  std::size_t size() const { return places_.size(); }
  const Vector2d& place(std::size_t i) const { return places_[i].position; }
  /// Distance from a place to the nearest wall (m), at most `ample_m`.
  double room(std::size_t i) const { return places_[i].room; }
  /// Places linked with this one.
  std::span<const int> links(std::size_t i) const;

  /// Whether the straight piece keeps the clearance from all walls.
  bool is_clear(const Vector2d& from, const Vector2d& to) const;
  /// The place that is nearest of those a clear piece leads to; -1 for none within two squares.
  int place_near(const Vector2d& point) const;
  const DriveMapOptions& options() const { return options_; }

 private:
  struct Place {
    Vector2d position;
    double room = 0.0;
  };

  DriveMapOptions options_;
  WallBuckets walls_;
  Vector2d corner_ = Vector2d::Zero();
  double pitch_m_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> place_in_square_;  // -1: none
  std::vector<Place> places_;
  std::vector<int> first_link_;  // packed
  std::vector<int> links_;
};

}  // namespace adit
