#include "adit/matching/chain_search.hpp"

#include <algorithm>

namespace adit {

std::span<const int> ChainSearch::find(const BitMatrix& graph, std::span<const int> ranks, int lap,
                                       std::span<const std::int64_t> weights, int max_calls) {
  graph_ = &graph;
  ranks_ = ranks;
  weights_ = weights;
  size_ = graph.size();
  lap_ = lap;
  calls_ = 0;
  max_calls_ = max_calls;
  stopped_ = false;
  best_.clear();
  best_weight_ = 0;
  list_successors(graph, ranks);
  tabulate_leading_out();
  order_starts();
  leading_in_.assign(size_ * size_, 0);
  for (const Start& start : starts_) {
    if (stopped_ || start.bound <= best_weight_) break;
    search_from(start.first);
  }
  return best_;
}

void ChainSearch::list_successors(const BitMatrix& graph, std::span<const int> ranks) {
  follows_.reset(size_);
  successors_.clear();
  first_of_.clear();
  for (std::size_t u = 0; u < size_; ++u) {
    first_of_.push_back(successors_.size());
    for (std::size_t v = u + 1; v < size_; ++v) {
      if (!graph.test(u, v) || ranks[v] < ranks[u] || ranks[v] > ranks[u] + lap_) continue;
      follows_.set(u, v);
      successors_.push_back(static_cast<int>(v));
    }
  }
  first_of_.push_back(successors_.size());
}

// Backwards through the list. The successors of v are already sorted when v is asked for, so the
// first of them that also follows u is the best.
void ChainSearch::tabulate_leading_out() {
  leading_out_.assign(size_ * size_, 0);
  for (std::size_t u = size_; u-- > 0;) {
    const auto begin = successors_.begin() + static_cast<std::ptrdiff_t>(first_of_[u]);
    const auto end = successors_.begin() + static_cast<std::ptrdiff_t>(first_of_[u + 1]);
    for (auto next = begin; next != end; ++next) {
      const auto v = static_cast<std::size_t>(*next);
      std::int64_t beyond = weights_[v];
      for (std::size_t i = first_of_[v]; i < first_of_[v + 1]; ++i) {
        const int w = successors_[i];
        if (!follows_.test(u, static_cast<std::size_t>(w))) continue;
        beyond = leading_out_[at(*next, w)];
        break;
      }
      leading_out_[u * size_ + v] = weights_[u] + beyond;
    }
    std::sort(begin, end, [&](int a, int b) {
      const std::int64_t out_a = leading_out_[u * size_ + static_cast<std::size_t>(a)];
      const std::int64_t out_b = leading_out_[u * size_ + static_cast<std::size_t>(b)];
      return out_a != out_b ? out_a > out_b : a < b;
    });
  }
}

void ChainSearch::order_starts() {
  starts_.clear();
  for (std::size_t u = 0; u < size_; ++u) {
    const bool alone = first_of_[u] == first_of_[u + 1];
    const std::int64_t bound =
        alone ? weights_[u] : leading_out_[at(static_cast<int>(u), successors_[first_of_[u]])];
    starts_.push_back({bound, static_cast<int>(u)});
  }
  std::sort(starts_.begin(), starts_.end(), [](const Start& a, const Start& b) {
    return a.bound != b.bound ? a.bound > b.bound : a.first < b.first;
  });
}

void ChainSearch::search_from(int first) {
  const auto u = static_cast<std::size_t>(first);
  current_.assign(1, first);
  if (weights_[u] > best_weight_) {
    best_weight_ = weights_[u];
    best_ = current_;
  }
  for (std::size_t i = first_of_[u]; i < first_of_[u + 1] && !stopped_; ++i) {
    const int second = successors_[i];
    if (leading_out_[at(first, second)] <= best_weight_) return;
    current_.push_back(second);
    extend(first, second, weights_[u] + weights_[static_cast<std::size_t>(second)]);
    current_.pop_back();
    // How a sequence may close depends on its first two, so this holds for one start only.
    for (const std::size_t entry : touched_) leading_in_[entry] = 0;
    touched_.clear();
  }
}

void ChainSearch::extend(int u, int v, std::int64_t weight) {
  if (calls_ >= max_calls_) {
    stopped_ = true;
    return;
  }
  ++calls_;
  record_if_closed(u, v, weight);
  const auto last = static_cast<std::size_t>(v);
  const int highest_rank = ranks_[static_cast<std::size_t>(current_.front())] + lap_;
  for (std::size_t i = first_of_[last]; i < first_of_[last + 1] && !stopped_; ++i) {
    const int w = successors_[i];
    const auto next = static_cast<std::size_t>(w);
    if (weight - weights_[last] + leading_out_[at(v, w)] <= best_weight_) return;
    if (!follows_.test(static_cast<std::size_t>(u), next) || ranks_[next] > highest_rank) continue;
    const std::int64_t extended = weight + weights_[next];
    std::int64_t& reached = leading_in_[at(v, w)];
    if (extended <= reached) continue;
    if (reached == 0) touched_.push_back(at(v, w));
    reached = extended;
    current_.push_back(w);
    extend(v, w, extended);
    current_.pop_back();
  }
}

// Of a sequence of up to three, each already agrees with all others.
bool ChainSearch::closes(int u, int v) const {
  if (current_.size() <= 3) return true;
  const auto first = static_cast<std::size_t>(current_[0]);
  const auto second = static_cast<std::size_t>(current_[1]);
  const auto last = static_cast<std::size_t>(v);
  return graph_->test(last, first) && graph_->test(last, second) &&
         graph_->test(static_cast<std::size_t>(u), first);
}

void ChainSearch::record_if_closed(int u, int v, std::int64_t weight) {
  if (weight <= best_weight_ || !closes(u, v)) return;
  best_weight_ = weight;
  best_ = current_;
}

}  // namespace adit
