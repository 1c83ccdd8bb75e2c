#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "adit/map/line_map.hpp"

namespace adit {

/// The space between two walls of the plan that meet, or would if they went on, counter-clockwise
/// from one to the other. In single precision, relative to an origin.
struct Sector {
  float x = 0.0F;  ///< where they meet (m)
  float y = 0.0F;
  float along_x = 1.0F;  ///< unit vector along the wall at which it begins
  float along_y = 0.0F;
  float opening = 0.0F;  ///< rad, in (0, 2 pi)
};

/// Which walls make a corner.
struct CornerLimits {
  double least_arm_m = 1.5;      ///< walls of a corner are no shorter ...
  double least_turn_rad = 0.35;  ///< ... and turn at it by no less
  double longest_gap_m = 8.0;    ///< that a rounded or chamfered corner leaves on either side
};

/// Where two walls meet, and which way they leave from there.
struct Meet {
  Vector2d point = Vector2d::Zero();
  Vector2d along_a = Vector2d::UnitX();  ///< unit vectors
  Vector2d along_b = Vector2d::UnitX();
  double gap_m = 0.0;  ///< how far off the farther wall ends
};

/// Turned counter-clockwise from one direction to another, in [0, 2 pi).
inline double turned(double from, double to) {
  const double turn = wrap_angle(to - from);
  return turn < 0.0 ? turn + kTwoPi : turn;
}

/// The corner that two walls make, none if they do not.
std::optional<Meet> corner_of(const Segment& a, const Segment& b, const CornerLimits& limits);

/// The corners of a plan by how wide they open and how far their walls end from where they meet.
class CornerIndex {
 public:
  CornerIndex() = default;
  CornerIndex(const LineMap& map, const Vector2d& origin, const CornerLimits& limits = {});

  /// How wide a corner opens, and how far off its walls may end.
  struct Likeness {
    double opening_rad = 0.0;
    double tolerance_rad = 0.0;
    double longest_gap_m = 0.0;
  };

  /// Calls `each(first, sectors)` for runs of sectors, by the number of their first: all that are
  /// like this, and some that are nearly so. Near ones follow each other.
  template <class Each>
  void visit(const Likeness& like, const Each& each) const {
    if (sectors_.empty()) return;
    const std::size_t last = width_of(like.opening_rad + like.tolerance_rad);
    for (std::size_t w = width_of(like.opening_rad - like.tolerance_rad); w <= last; ++w) {
      const std::size_t first = begins_[w * kGaps];
      const std::size_t end = begins_[w * kGaps + gap_of(like.longest_gap_m) + 1];
      if (first < end) each(first, std::span(sectors_).subspan(first, end - first));
    }
  }

  const Sector& sector(std::size_t number) const { return sectors_[number]; }
  std::size_t size() const { return sectors_.size(); }
  /// Bytes that it holds.
  std::size_t memory() const;

 private:
  static constexpr std::size_t kWidths = 180;  // of two degrees
  static constexpr std::size_t kGaps = 9;      // of a metre
  static std::size_t width_of(double opening_rad);
  static std::size_t gap_of(double gap_m);

  std::vector<Sector> sectors_;      // by width, then by gap, then as the map's walls
  std::vector<std::size_t> begins_;  // of each width and gap
};

}  // namespace adit
