#include "adit/survey/wall_chains.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

/// Which two nodes may be linked in one round.
struct LinkRule {
  double reach = 0.0;         // m
  double least_turn = 0.0;    // cosine between the two walls' directions
  double least_ahead = 0.0;   // cosine between each direction and the way from one to the other
  bool check_passes = false;  // whether beams that go through the gap forbid the link ...
  double behind = 0.0;        // ... so far behind it (m): flat beams graze a wall that has no gap
};

class Linker {
 public:
  Linker(std::span<const WallNode> nodes, BeamEvidence& evidence, const WallOptions& options)
      : nodes_(nodes),
        evidence_(evidence),
        options_(options),
        cells_(std::max(options.gap_m, options.corner_gap_m) + node_spacing(options)),
        next_(nodes.size(), -1),
        previous_(nodes.size(), -1) {
    next_in_cell_.assign(nodes.size(), -1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      int& first = cells_.at(cells_.cell_at(nodes[i].point)).first;
      next_in_cell_[i] = first;
      first = static_cast<int>(i);
    }
  }

  /// Links the ends that are each other's best choice, until there are no more.
  void link(const LinkRule& rule) {
    for (bool changed = true; changed;) {
      changed = false;
      for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
        if (next_[at(i)] >= 0) continue;
        const int j = best_next(i, rule);
        if (j < 0 || best_previous(j, rule) != i) continue;
        next_[at(i)] = j;
        previous_[at(j)] = i;
        changed = true;
      }
    }
  }

  std::vector<WallChain> chains() const {
    std::vector<WallChain> chains;
    std::vector<char> done(nodes_.size(), 0);
    const auto follow = [&](int start, bool closed) {
      WallChain chain{{}, closed};
      for (int i = start; i >= 0 && done[at(i)] == 0; i = next_[at(i)]) {
        done[at(i)] = 1;
        chain.nodes.push_back(i);
      }
      chains.push_back(std::move(chain));
    };
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
      if (previous_[at(i)] < 0) follow(i, false);
    }
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
      if (done[at(i)] == 0) follow(i, true);
    }
    return chains;
  }

 private:
  struct First {
    int first = -1;
  };
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  /// Cost of going from one node to another; below zero when the rule forbids it.
  double cost(int from, int to, const LinkRule& rule) {
    const WallNode& a = nodes_[at(from)];
    const WallNode& b = nodes_[at(to)];
    const Vector2d way = b.point - a.point;
    const double length = way.norm();
    if (length > rule.reach || length <= 0.0) return -1.0;
    const double turn = a.normal.dot(b.normal);
    if (turn < rule.least_turn) return -1.0;
    const double leave = a.along().dot(way) / length;
    const double arrive = b.along().dot(way) / length;
    if (std::min(leave, arrive) < rule.least_ahead) return -1.0;
    if (rule.check_passes && is_open(a, b, rule.behind)) return -1.0;
    return length * (1.0 + 2.0 * (1.0 - leave) + 2.0 * (1.0 - arrive) + (1.0 - turn));
  }

  /// Whether more beams went through the gap than can have strayed into it.
  bool is_open(const WallNode& a, const WallNode& b, double behind) {
    const Vector2d way = b.point - a.point;
    const Vector2d start = a.point - behind * (a.normal + b.normal).normalized();
    const double hits = std::min(a.hits, b.hits) / (node_spacing(options_) / options_.cell_m);
    const int steps = static_cast<int>(way.norm() / options_.cell_m);
    int open = 0;
    for (int i = 2; i + 1 < steps; ++i) {
      const int passes = evidence_.passes_at(start + way * (static_cast<double>(i) / steps));
      if (passes > 2 && passes > 0.5 * hits) ++open;
    }
    return open >= 2;
  }

  template <class Allowed>
  int best_near(int i, const LinkRule& rule, bool forward, const Allowed& allowed) {
    int best = -1;
    double least = 1e300;
    const GridCell here = cells_.cell_at(nodes_[at(i)].point);
    for (std::int32_t y = here.y - 1; y <= here.y + 1; ++y) {
      for (std::int32_t x = here.x - 1; x <= here.x + 1; ++x) {
        const First* cell = cells_.find({x, y});
        if (cell == nullptr) continue;
        for (int j = cell->first; j >= 0; j = next_in_cell_[at(j)]) {
          if (j == i || !allowed(j)) continue;
          const double c = forward ? cost(i, j, rule) : cost(j, i, rule);
          if (c < 0.0 || c > least || (c == least && j > best)) continue;
          least = c;
          best = j;
        }
      }
    }
    return best;
  }
  int best_next(int i, const LinkRule& rule) {
    return best_near(i, rule, true, [&](int j) { return previous_[at(j)] < 0; });
  }
  int best_previous(int i, const LinkRule& rule) {
    return best_near(i, rule, false, [&](int j) { return next_[at(j)] < 0; });
  }

  std::span<const WallNode> nodes_;
  BeamEvidence& evidence_;
  const WallOptions& options_;
  TileGrid<First> cells_;
  std::vector<int> next_in_cell_;
  std::vector<int> next_;
  std::vector<int> previous_;
};

}  // namespace

std::vector<WallChain> link_wall_nodes(std::span<const WallNode> nodes, BeamEvidence& evidence,
                                       const WallOptions& options) {
  Linker linker(nodes, evidence, options);
  const double spacing = node_spacing(options);
  linker.link({2.5 * spacing, 0.5, 0.6, false});          // neighbours
  linker.link({options.corner_gap_m, -0.5, -0.3, true});  // round a corner
  linker.link(
      {options.gap_m, 0.8, 0.85, true, 0.5 * options.seen_through_m});  // straight across a gap
  return linker.chains();
}

}  // namespace adit
