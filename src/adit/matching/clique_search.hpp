#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adit/matching/bit_matrix.hpp"

namespace adit {

/// Maximum-weight clique by depth-first search with a greedy colouring as the cut-off.
///
/// Follows Tomita & Seki 2003 (colour bound) and San Segundo et al. 2011 (bit sets), with the
/// weights in the bound as in Kumlander 2004. A greedy clique first prunes the vertices that have
/// too few neighbours. Deterministic; keeps its buffers between calls.
class CliqueSearch {
 public:
  /// Vertices of the heaviest clique of a symmetric graph, ascending; weights are positive. After
  /// `max_calls` recursive calls the best so far is taken.
  std::span<const int> find(const BitMatrix& graph, std::span<const std::int64_t> weights,
                            int max_calls);

  int calls() const { return calls_; }
  bool is_maximum() const { return !stopped_; }

 private:
  void order_by_weight(std::span<const std::int64_t> weights);
  void find_greedy_clique(const BitMatrix& graph, std::span<const std::int64_t> weights);
  void drop_hopeless(const BitMatrix& graph);
  void build_subgraph(const BitMatrix& graph, std::span<const std::int64_t> weights);
  void expand(std::size_t depth, std::int64_t weight);
  std::size_t colour(const std::uint64_t* open);
  void record(std::int64_t weight);

  std::vector<int> order_;    // vertices, heaviest first; those worth searching after drop_hopeless
  std::vector<int> best_;     // vertices of the graph
  std::vector<int> current_;  // positions in order_
  BitMatrix subgraph_;        // over positions in order_
  std::vector<std::int64_t> weight_;
  std::vector<std::uint64_t> alive_;
  std::vector<std::uint64_t> uncoloured_;
  std::vector<std::uint64_t> colour_class_;
  std::vector<std::uint64_t> open_;  // a row of candidates for every depth
  struct Branch {
    int vertex = 0;
    std::int64_t bound = 0;  // of what the cliques among this and the earlier branches can weigh
  };
  std::vector<Branch> branches_;  // a stack of the colourings of all depths
  std::int64_t best_weight_ = 0;
  int calls_ = 0;
  int max_calls_ = 0;
  bool stopped_ = false;
};

}  // namespace adit
