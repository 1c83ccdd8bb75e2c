#include "adit/survey/wall_nodes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace adit {
namespace {

constexpr double kSameWall = 0.7;      // cosine of normals of one wall
constexpr double kWindow = 2.5;        // sigmas at which a window ends
constexpr double kMergeOfNoise = 1.5;  // width of a band in sigmas of the scanner
constexpr int kMoves = 6;
constexpr double kStill = 1e-3;  // m

/// A facet on its way to the middle of the wall.
struct Settled {
  WallNode node;
  double density = 0.0;
  bool alive = false;
};

class Settler {
 public:
  Settler(BeamEvidence& evidence, const ScannerModel& scanner, const WallOptions& options)
      : evidence_(evidence),
        options_(options),
        across_(std::max(options.merge_m, kMergeOfNoise * scanner.beam_sigma_m())),
        along_(std::max(options.smooth_m, across_)) {}

  double across() const { return across_; }

  bool counts(const Facet& facet) const {
    return facet.occupied_share() >= options_.occupied_share;
  }

  Settled settle(const Facet& facet) {
    Settled out;
    out.node.point = facet.point;
    out.node.normal = facet.normal;
    for (int i = 0; i < kMoves; ++i) {
      const Window window = gather(out.node);
      if (window.weight <= 0.0) return out;
      out.alive = true;
      out.density = window.weight;
      if (move(window, out.node) < kStill) break;
    }
    return out;
  }

 private:
  struct Window {
    Moments moments;  // relative to the node
    double weight = 0.0;
    Vector2d normal = Vector2d::Zero();
  };

  Window gather(const WallNode& node) {
    Window window;
    const double reach = kWindow * along_;
    evidence_.visit_near(node.point, reach, [&](int i) {
      const Facet& f = evidence_.facets()[static_cast<std::size_t>(i)];
      if (f.normal.dot(node.normal) < kSameWall || !counts(f)) return;
      const Vector2d d = f.point - node.point;
      const double across = d.dot(node.normal) / across_;
      const double along = cross(d, node.normal) / along_;
      if (std::abs(across) > kWindow || std::abs(along) > kWindow) return;
      const double w = f.weight * std::exp(-0.5 * (across * across + along * along));
      Moments& m = window.moments;
      m = m +
          Moments{w, w * d.x(), w * d.y(), w * d.x() * d.x(), w * d.x() * d.y(), w * d.y() * d.y()};
      window.weight += w;
      window.normal += w * f.normal;
    });
    return window;
  }

  /// Moves the node across the wall onto the window's line; how far (m).
  double move(const Window& window, WallNode& node) const {
    const LineFit line = fit_line(window.moments);
    const Vector2d mean_normal = window.normal.normalized();
    Vector2d normal = perpendicular(line.direction);
    if (normal.dot(mean_normal) < 0.0) normal = -normal;
    // A window that is as wide as long has no direction of its own.
    const double across = line.squared_error;
    const double all =
        window.moments.xx + window.moments.yy - window.moments.n * line.centroid.squaredNorm();
    const bool slender = all > 5.0 * across && normal.dot(mean_normal) > kSameWall;
    node.normal = slender ? normal : mean_normal;
    node.scatter = across / window.weight;
    const double shift = line.centroid.dot(node.normal);
    node.point += shift * node.normal;
    return std::abs(shift);
  }

  BeamEvidence& evidence_;
  const WallOptions& options_;
  double across_;
  double along_;
};

/// The chosen nodes, found by place.
class NodeGrid {
 public:
  NodeGrid(double reach, std::vector<WallNode>& nodes) : cells_(reach), nodes_(nodes) {}

  void add(const WallNode& node) {
    int& first = cells_.at(cells_.cell_at(node.point)).first;
    next_.push_back(first);
    first = static_cast<int>(nodes_.size());
    nodes_.push_back(node);
  }

  template <class Take>
  void visit_near(const Vector2d& place, const Take& take) {
    const GridCell at = cells_.cell_at(place);
    for (std::int32_t y = at.y - 1; y <= at.y + 1; ++y) {
      for (std::int32_t x = at.x - 1; x <= at.x + 1; ++x) {
        const First* cell = cells_.find({x, y});
        if (cell == nullptr) continue;
        for (int n = cell->first; n >= 0; n = next_[static_cast<std::size_t>(n)]) take(n);
      }
    }
  }

 private:
  struct First {
    int first = -1;
  };
  TileGrid<First> cells_;
  std::vector<WallNode>& nodes_;
  std::vector<int> next_;
};

/// Whether a node stands for this place of a wall already.
bool covers(const WallNode& node, const WallNode& other, double along, double across) {
  if (node.normal.dot(other.normal) < kSameWall) return false;
  const Vector2d d = other.point - node.point;
  return std::abs(d.dot(node.normal)) < across && std::abs(cross(d, node.normal)) < along;
}

/// Gives each node what supports it: the facets nearest to it along the wall. A scan that meets
/// two of a node's facets counts twice.
void add_support(BeamEvidence& evidence, const std::vector<Settled>& settled, double spacing,
                 double across, const WallOptions& options, NodeGrid& grid,
                 std::vector<WallNode>& nodes) {
  std::vector<double> weights(nodes.size(), 0.0);
  std::vector<double> visits(nodes.size(), 0.0);
  std::vector<std::uint64_t> visit_sets(nodes.size(), 0);
  std::vector<std::uint64_t> scan_sets(nodes.size(), 0);
  for (std::size_t i = 0; i < settled.size(); ++i) {
    if (!settled[i].alive) continue;
    const Facet& facet = evidence.facets()[i];
    int best = -1;
    double least = spacing;
    grid.visit_near(settled[i].node.point, [&](int n) {
      const WallNode& node = nodes[static_cast<std::size_t>(n)];
      const double distance = (node.point - settled[i].node.point).norm();
      if (distance >= least || !covers(node, settled[i].node, spacing, across)) return;
      least = distance;
      best = n;
    });
    if (best < 0) continue;
    WallNode& node = nodes[static_cast<std::size_t>(best)];
    weights[static_cast<std::size_t>(best)] += facet.weight;
    visits[static_cast<std::size_t>(best)] += facet.visits;
    node.hits += facet.hits;
    node.scans += facet.scans;
    node.visits = std::max(node.visits, facet.visits);
    visit_sets[static_cast<std::size_t>(best)] |= facet.visit_set;
    scan_sets[static_cast<std::size_t>(best)] |= facet.scan_set;
    node.sure = node.sure || facet.near;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].sure = nodes[i].sure || std::popcount(visit_sets[i]) >= options.min_far_visits ||
                    std::popcount(scan_sets[i]) >= options.min_far_scans;
    nodes[i].visit_information = weights[i] / std::max(visits[i], 1.0);
  }
}

}  // namespace

double node_spacing(const WallOptions& options) { return 2.0 * options.cell_m; }

std::vector<WallNode> find_wall_nodes(BeamEvidence& evidence, const ScannerModel& scanner,
                                      const WallOptions& options) {
  Settler settler(evidence, scanner, options);
  std::vector<Settled> settled;
  settled.reserve(evidence.facets().size());
  for (const Facet& facet : evidence.facets()) {
    settled.push_back(settler.counts(facet) ? settler.settle(facet) : Settled{});
  }
  std::vector<std::size_t> order(settled.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return settled[a].density > settled[b].density;
  });

  const double spacing = node_spacing(options);
  const double across = 2.0 * settler.across();
  std::vector<WallNode> nodes;
  NodeGrid grid(std::max(spacing, across) * 1.5, nodes);
  for (const std::size_t i : order) {
    if (!settled[i].alive) continue;
    bool taken = false;
    grid.visit_near(settled[i].node.point, [&](int n) {
      taken = taken || covers(nodes[static_cast<std::size_t>(n)], settled[i].node, spacing, across);
    });
    if (!taken) grid.add(settled[i].node);
  }
  add_support(evidence, settled, spacing, across, options, grid, nodes);
  std::erase_if(nodes, [&](const WallNode& node) {
    return node.scans < options.min_scans || node.hits < spacing * options.min_hits_per_m;
  });
  return nodes;
}

}  // namespace adit
