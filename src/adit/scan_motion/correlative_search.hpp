#pragma once

#include <optional>
#include <span>

#include "adit/scan_motion/evidence_field.hpp"

namespace adit {

/// Where a pose is looked for: the sigmas of the prior, and how far from its middle.
struct SearchWindow {
  Pose2 middle;  ///< field_from_points
  double reach_m = 0.5;
  double reach_rad = 0.2;
  double sigma_m = 0.2;  ///< of the prior; what departs from the middle scores less
  double sigma_rad = 0.1;
  double most_cost = 1e9;  ///< what departs farthest scores no less than by this
};

/// A pose and how well the points go with the field there: the mean of the field at the points, 0
/// to 1, and the same less what it costs to depart from the prior.
struct SearchPeak {
  Pose2 pose;
  double score = 0.0;
  double with_prior = 0.0;
};

/// The pose of the highest score within the window by branch and bound; none below `at_least`.
class CorrelativeSearch {
 public:
  /// A prior three sigmas off costs as much as this many points that hit no wall.
  static constexpr double kPointsPerNat = 10.0;

  /// Sets the points that are looked for: thinned so that no two lie closer than a cell.
  void set_points(std::span<const PlacedShape> shapes, const EvidenceField& field);
  std::size_t size() const { return points_.size(); }

  /// Poses within `apart_m` and `apart_rad` of `other_than`, where given, are left out.
  std::optional<SearchPeak> best(const EvidenceField& field, const SearchWindow& window,
                                 double at_least, const Pose2* other_than = nullptr,
                                 double apart_m = 0.0, double apart_rad = 0.0);

 private:
  struct Node {
    float bound;
    int angle;
    int level;
    int column;
    int row;
  };
  struct Cell {
    int column;
    int row;
  };
  struct Query;

  double score(const EvidenceField& field, int angle, int level, int column, int row) const;
  void rotate(const EvidenceField& field, const SearchWindow& window, double step_rad, int angles);
  void descend(const Query& query, const Node& node);

  std::vector<Vector2d> points_;
  double radius_ = 1.0;
  std::vector<std::vector<Cell>> rotated_;
  std::vector<Node> nodes_;
  std::optional<SearchPeak> best_;
  double threshold_ = 0.0;
};

}  // namespace adit
