#include "adit/scan_motion/correlative_search.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace adit {

struct CorrelativeSearch::Query {
  const EvidenceField& field;
  const SearchWindow& window;
  double step_rad = 0.0;
  int angles = 0;  // to either side
  int reach = 0;   // cells to every side
  const Pose2* other_than = nullptr;
  double apart_m = 0.0;
  double apart_rad = 0.0;
  double per_nat = 0.0;

  double turn_of(int angle) const { return (angle - angles) * step_rad; }

  /// What the prior takes off, at least, for the shifts [column, column + span) and rows alike.
  double least_cost(int angle, int column, int row, int span) const {
    const auto nearest = [span](int first) {
      return first > 0 ? first : std::min(0, first + span - 1);
    };
    const double cell = field.cell_m();
    const double dx = cell * nearest(column) / window.sigma_m;
    const double dy = cell * nearest(row) / window.sigma_m;
    const double dt = turn_of(angle) / window.sigma_rad;
    return std::min(window.most_cost, 0.5 * (dx * dx + dy * dy + dt * dt) * per_nat);
  }

  bool is_left_out(const Pose2& pose) const {
    if (other_than == nullptr) return false;
    const Vector3d off = difference(*other_than, pose);
    return off.head<2>().norm() < apart_m && std::abs(off.z()) < apart_rad;
  }
};

void CorrelativeSearch::set_points(std::span<const PlacedShape> shapes,
                                   const EvidenceField& field) {
  struct Tagged {
    int column;
    int row;
    Vector2d point;
  };
  std::vector<Tagged> all;
  const double side = field.cell_m();
  for (const PlacedShape& s : shapes) {
    const RigidTransform carry_by(s.frame_from_shape);
    for (const SurfacePoint& p : s.shape->points) {
      const Vector2d point = carry_by.point(p.point.cast<double>());
      all.push_back({static_cast<int>(std::floor(point.x() / side)),
                     static_cast<int>(std::floor(point.y() / side)), point});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Tagged& a, const Tagged& b) {
    return std::tie(a.column, a.row) < std::tie(b.column, b.row);
  });
  points_.clear();
  std::vector<double> ranges;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0 && all[i].column == all[i - 1].column && all[i].row == all[i - 1].row) continue;
    points_.push_back(all[i].point);
    ranges.push_back(all[i].point.norm());
  }
  radius_ = 2.0;
  if (ranges.empty()) return;
  const std::size_t rank = ranges.size() * 9 / 10;
  std::nth_element(ranges.begin(), ranges.begin() + static_cast<std::ptrdiff_t>(rank),
                   ranges.end());
  radius_ = std::clamp(ranges[rank], 2.0, 20.0);
}

void CorrelativeSearch::rotate(const EvidenceField& field, const SearchWindow& window,
                               double step_rad, int angles) {
  rotated_.resize(2 * static_cast<std::size_t>(angles) + 1);
  for (int a = 0; a <= 2 * angles; ++a) {
    Pose2 pose = window.middle;
    pose.theta += (a - angles) * step_rad;
    const RigidTransform carry_by(pose);
    std::vector<Cell>& cells = rotated_[static_cast<std::size_t>(a)];
    cells.resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vector2d p = carry_by.point(points_[i]);
      cells[i] = {field.column(p.x()), field.row(p.y())};
    }
  }
}

double CorrelativeSearch::score(const EvidenceField& field, int angle, int level, int column,
                                int row) const {
  const std::vector<Cell>& cells = rotated_[static_cast<std::size_t>(angle)];
  std::uint32_t sum = 0;
  for (const Cell& cell : cells) sum += field.at(level, cell.column + column, cell.row + row);
  return sum / (255.0 * static_cast<double>(cells.size()));
}

void CorrelativeSearch::descend(const Query& query, const Node& node) {
  if (node.bound <= threshold_) return;
  if (node.level == 0) {
    Pose2 pose = query.window.middle;
    pose.x += node.column * query.field.cell_m();
    pose.y += node.row * query.field.cell_m();
    pose.theta = wrap_angle(pose.theta + query.turn_of(node.angle));
    if (query.is_left_out(pose)) return;
    const double cost = query.least_cost(node.angle, node.column, node.row, 1);
    best_ = {pose, node.bound + cost, node.bound};
    threshold_ = node.bound;
    return;
  }
  const int level = node.level - 1;
  const int half = 1 << level;
  std::array<Node, 4> children;
  std::size_t count = 0;
  for (const int dy : {0, half}) {
    for (const int dx : {0, half}) {
      const int column = node.column + dx;
      const int row = node.row + dy;
      if (column > query.reach || row > query.reach) continue;
      const double bound = score(query.field, node.angle, level, column, row) -
                           query.least_cost(node.angle, column, row, half);
      children[count++] = {static_cast<float>(bound), node.angle, level, column, row};
    }
  }
  const std::span<Node> inside(children.data(), count);
  std::stable_sort(inside.begin(), inside.end(),
                   [](const Node& a, const Node& b) { return a.bound > b.bound; });
  for (const Node& child : inside) descend(query, child);
}

std::optional<SearchPeak> CorrelativeSearch::best(const EvidenceField& field,
                                                  const SearchWindow& window, double at_least,
                                                  const Pose2* other_than, double apart_m,
                                                  double apart_rad) {
  best_.reset();
  threshold_ = at_least;
  if (points_.empty()) return best_;
  const double step_rad = field.cell_m() / radius_;
  const int angles = static_cast<int>(std::ceil(std::min(window.reach_rad, kPi) / step_rad));
  const int reach = static_cast<int>(std::ceil(window.reach_m / field.cell_m()));
  const double per_nat =
      kPointsPerNat / static_cast<double>(std::max<std::size_t>(points_.size(), 60));
  const Query query{field,      window,  step_rad,  angles, reach,
                    other_than, apart_m, apart_rad, per_nat};
  rotate(field, window, step_rad, angles);
  int level = 0;
  while (level + 1 < EvidenceField::kLevels && (2 << level) < reach) ++level;
  nodes_.clear();
  for (int a = 0; a <= 2 * angles; ++a) {
    for (int row = -reach; row <= reach; row += 1 << level) {
      for (int column = -reach; column <= reach; column += 1 << level) {
        const double bound =
            score(field, a, level, column, row) - query.least_cost(a, column, row, 1 << level);
        if (bound > threshold_) {
          nodes_.push_back({static_cast<float>(bound), a, level, column, row});
        }
      }
    }
  }
  std::stable_sort(nodes_.begin(), nodes_.end(),
                   [](const Node& a, const Node& b) { return a.bound > b.bound; });
  for (const Node& node : nodes_) descend(query, node);
  return best_;
}

}  // namespace adit
