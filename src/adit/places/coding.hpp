#pragma once

#include <cstddef>
#include <cstdint>

namespace adit {

/// What an index of places is made with beside its options: nobody sets these, but an index that
/// was made with others is another one, and its file is refused.
struct PlaceCoding {
  std::uint64_t edition = 1;  ///< raised where other code makes another index of the same constants
  std::size_t bins = 64;      ///< bearings of a turn, each with a code
  std::size_t rays_per_bin = 8;
  std::size_t margin = 2;     ///< so many rays of its neighbours count in a bin on either side
  double farthest_m = 100.0;  ///< all ranges from here on have one code ...
  std::uint8_t nothing_in_sight = 250;  ///< ... which is this
  double linear_m = 4.0;                ///< below, codes are near linear
  double first_place = 0.5;             ///< so many pitches from the edges of the plan's box
  int area_samples = 60;                ///< of the inside, along each side of the box ...
  double area_shift = 0.618034;         ///< ... each row off the one before by this part of a step
  double most_squares = 1.5e7;          ///< looking at more squares for places takes minutes

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("edition", self.edition);
    field("bins", self.bins);
    field("rays_per_bin", self.rays_per_bin);
    field("margin", self.margin);
    field("farthest_m", self.farthest_m);
    field("nothing_in_sight", self.nothing_in_sight);
    field("linear_m", self.linear_m);
    field("first_place", self.first_place);
    field("area_samples", self.area_samples);
    field("area_shift", self.area_shift);
    field("most_squares", self.most_squares);
  }
};

inline constexpr PlaceCoding kPlaceCoding;

}  // namespace adit
