#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adit/matching/bit_matrix.hpp"

namespace adit {

/// The paper's search: the longest sequence of the ordered list of pairs in which each agrees with
/// the two before it, the first two with the last ones in turn, since the order is cyclic.
///
/// A sequence p_1 ... p_k ascends in the list, its ranks never fall, and rise by one lap at most;
/// p_i agrees with p_i-1 and p_i-2 (indices modulo k). The heaviest sequence leading out of every
/// two neighbours is tabulated first; it and the heaviest sequence found so far that leads into
/// them end fruitless branches. Deterministic; keeps its buffers between calls.
class ChainSearch {
 public:
  /// Positions in the list of the heaviest sequence, ascending. `ranks` are the model features' of
  /// the list's pairs, `lap` is the count of model features. After `max_calls` recursive calls the
  /// best so far is taken.
  std::span<const int> find(const BitMatrix& graph, std::span<const int> ranks, int lap,
                            std::span<const std::int64_t> weights, int max_calls);

  int calls() const { return calls_; }
  bool is_maximum() const { return !stopped_; }

 private:
  struct Start {
    std::int64_t bound = 0;
    int first = 0;
  };

  std::size_t at(int u, int v) const {
    return static_cast<std::size_t>(u) * size_ + static_cast<std::size_t>(v);
  }
  void list_successors(const BitMatrix& graph, std::span<const int> ranks);
  void tabulate_leading_out();
  void order_starts();
  void search_from(int first);
  void extend(int u, int v, std::int64_t weight);
  bool closes(int u, int v) const;
  void record_if_closed(int u, int v, std::int64_t weight);

  const BitMatrix* graph_ = nullptr;
  std::span<const int> ranks_;
  std::span<const std::int64_t> weights_;
  std::size_t size_ = 0;
  int lap_ = 0;
  BitMatrix follows_;                      // (u, v): v may come next after u
  std::vector<int> successors_;            // of u, by falling weight leading out of (u, successor)
  std::vector<std::size_t> first_of_;      // successors_ of u: [first_of_[u], first_of_[u + 1])
  std::vector<std::int64_t> leading_out_;  // from (u, v) on, u and v included; without closing
  std::vector<std::int64_t> leading_in_;   // up to (u, v), both included, from the current start
  std::vector<std::size_t> touched_;       // entries of leading_in_ to clear
  std::vector<Start> starts_;
  std::vector<int> current_;
  std::vector<int> best_;
  std::int64_t best_weight_ = 0;
  int calls_ = 0;
  int max_calls_ = 0;
  bool stopped_ = false;
};

}  // namespace adit
