#pragma once

#include <functional>
#include <span>
#include <vector>

#include "adit/survey/looked_at.hpp"

namespace adit {

/// A stretch of a surveyed wall that stands for what a change removed.
struct Replacement {
  std::size_t change = 0;
  std::size_t wall = 0;
  SegmentPart stretch;
};

/// Shares surveyed walls out among the walls of the plan that moved there, so that each change can
/// be accepted without the others.
class ReplacedWalls {
 public:
  explicit ReplacedWalls(std::span<const Segment> surveyed)
      : surveyed_(surveyed), claims_(surveyed.size()) {}

  /// A place of what the change removed now lies at this point of a wall.
  void claim(std::size_t change, std::size_t wall, const Vector2d& point);
  bool is_claimed(std::size_t wall) const { return !claims_[wall].empty(); }

  /// Every change's stretches. They grow by steps beyond the places that were claimed, to the next
  /// change's, to the wall's end, or to where `is_plans_own` says that the plan has the wall.
  std::vector<Replacement> share_out(
      double step_m, const std::function<bool(std::size_t wall, const Vector2d&)>& is_plans_own);

 private:
  struct Claim {
    std::size_t change = 0;
    SegmentPart stretch;
  };
  /// Neighbouring places of one change together.
  static std::vector<Claim> joined(std::vector<Claim> claims, double step_m);
  static std::vector<Claim> apart(std::vector<Claim> claims);

  std::span<const Segment> surveyed_;
  std::vector<std::vector<Claim>> claims_;  // of each wall
};

}  // namespace adit
