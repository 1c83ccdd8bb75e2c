#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// A wall as a sweep meets it: counter-clockwise from `begin` to `end` around the observer, who is
/// the origin, and cut to the scanner's range.
struct SweptWall {
  Vector2d begin = Vector2d::Zero();
  Vector2d end = Vector2d::Zero();
  /// cross(direction, inverse_range) is 1 / range along a unit direction: linear in the direction.
  Vector2d inverse_range = Vector2d::Zero();
  double rounding = 0.0;  ///< relative error of 1 / range; large for a wall that is almost edge-on
  double begin_key = 0.0;
  double end_key = 0.0;
  int wall = -1;          ///< index in the map
  int begin_vertex = -1;  ///< -1 where the range cuts the wall
  int end_vertex = -1;
};

/// The nearest walls around a point: the lower envelope of segments in polar form.
///
/// Walls are staged, then merged into what is there already: sorted by bearing and joined two by
/// two, O(k log k) in the staged walls plus the pieces that exist. Walls need not be free of
/// crossings: two that cross swap places at the crossing.
class Envelope {
 public:
  /// From key `begin` to key `end` the nearest wall is `wall` (an index for `wall()`).
  struct Piece {
    double begin = 0.0;
    double end = 0.0;
    int wall = -1;
  };

  /// Forgets everything but keeps the memory.
  void clear();

  /// Adds a wall to those that the next merge takes in.
  void stage(const SweptWall& wall);

  /// Takes the staged walls into the envelope.
  void merge_staged();

  /// Sorted by key; a wall that spans the bearing pi is cut there.
  std::span<const Piece> pieces() const { return pieces_; }
  const SweptWall& wall(int index) const { return walls_[static_cast<std::size_t>(index)]; }

  /// Notes how far the envelope reaches in each direction, for `hides` and `reach`.
  void measure_reach();

  /// Whether a wall that is nowhere nearer than this (m²) is surely hidden, as of `measure_reach`.
  bool hides(const SweptWall& wall, double squared_distance) const;

  /// Nothing beyond this distance can be seen, as of `measure_reach`; infinite where there are
  /// gaps.
  double reach() const { return reach_; }

 private:
  static constexpr std::size_t kSectors = 128;

  static std::size_t sector(double key);
  void raise_reach(double begin, double end, double squared_distance);
  double squared_range_at(int index, double key) const;
  void split_into_runs();
  void merge(std::span<const Piece> a, std::span<const Piece> b, std::vector<Piece>& out) const;
  void append_nearer(double begin, double end, int a, int b, std::vector<Piece>& out) const;

  std::vector<SweptWall> walls_;
  std::vector<Piece> pieces_;
  std::vector<Piece> staged_;
  std::vector<Piece> merged_;
  std::vector<std::size_t> run_ends_;
  std::array<double, kSectors> squared_reach_{};
  double reach_ = 0.0;
};

}  // namespace adit
