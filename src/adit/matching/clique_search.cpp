#include "adit/matching/clique_search.hpp"

#include <algorithm>
#include <numeric>

namespace adit {
namespace {

std::uint64_t bit(std::size_t index) { return std::uint64_t{1} << (index % 64); }

void intersect(const std::uint64_t* a, const std::uint64_t* b, std::size_t words,
               std::uint64_t* out) {
  for (std::size_t w = 0; w < words; ++w) out[w] = a[w] & b[w];
}

bool any(const std::uint64_t* bits, std::size_t words) {
  return std::any_of(bits, bits + words, [](std::uint64_t word) { return word != 0; });
}

int count_common(const std::uint64_t* a, const std::uint64_t* b, std::size_t words) {
  int count = 0;
  for (std::size_t w = 0; w < words; ++w) count += std::popcount(a[w] & b[w]);
  return count;
}

void fill(std::vector<std::uint64_t>& bits, std::size_t count) {
  bits.assign((count + 63) / 64, ~std::uint64_t{0});
  if (count % 64 != 0) bits.back() = bit(count) - 1;
}

}  // namespace

std::span<const int> CliqueSearch::find(const BitMatrix& graph,
                                        std::span<const std::int64_t> weights, int max_calls) {
  calls_ = 0;
  max_calls_ = max_calls;
  stopped_ = false;
  best_.clear();
  best_weight_ = 0;
  if (graph.size() == 0) return best_;
  order_by_weight(weights);
  find_greedy_clique(graph, weights);
  drop_hopeless(graph);
  if (order_.size() > best_.size()) {
    build_subgraph(graph, weights);
    expand(0, 0);
  }
  std::sort(best_.begin(), best_.end());
  return best_;
}

void CliqueSearch::order_by_weight(std::span<const std::int64_t> weights) {
  order_.resize(weights.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](int a, int b) {
    const std::int64_t weight_a = weights[static_cast<std::size_t>(a)];
    const std::int64_t weight_b = weights[static_cast<std::size_t>(b)];
    return weight_a != weight_b ? weight_a > weight_b : a < b;
  });
}

void CliqueSearch::find_greedy_clique(const BitMatrix& graph,
                                      std::span<const std::int64_t> weights) {
  fill(alive_, graph.size());
  for (const int vertex : order_) {
    const auto v = static_cast<std::size_t>(vertex);
    if ((alive_[v / 64] & bit(v)) == 0) continue;
    best_.push_back(vertex);
    best_weight_ += weights[v];
    intersect(alive_.data(), graph.row(v), graph.words(), alive_.data());
  }
}

// A vertex of a clique of k has k - 1 neighbours in it; dropping one may leave others too few.
void CliqueSearch::drop_hopeless(const BitMatrix& graph) {
  fill(alive_, graph.size());
  const int needed = static_cast<int>(best_.size()) - 1;
  for (bool changed = true; changed;) {
    const auto hopeless = [&](int vertex) {
      const auto v = static_cast<std::size_t>(vertex);
      if (count_common(graph.row(v), alive_.data(), graph.words()) >= needed) return false;
      alive_[v / 64] &= ~bit(v);
      return true;
    };
    const auto kept = std::remove_if(order_.begin(), order_.end(), hopeless);
    changed = kept != order_.end();
    order_.erase(kept, order_.end());
  }
}

void CliqueSearch::build_subgraph(const BitMatrix& graph, std::span<const std::int64_t> weights) {
  const std::size_t count = order_.size();
  subgraph_.reset(count);
  weight_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto v = static_cast<std::size_t>(order_[i]);
    weight_[i] = weights[v];
    for (std::size_t j = i + 1; j < count; ++j) {
      if (graph.test(v, static_cast<std::size_t>(order_[j]))) subgraph_.set_both(i, j);
    }
  }
  const std::size_t words = subgraph_.words();
  uncoloured_.resize(words);
  colour_class_.resize(words);
  fill(open_, count);
  current_.clear();
  branches_.clear();
}

// Colours the open vertices: no two of a class are neighbours, so a clique holds one of each class
// at most. Pushes a branch for each and returns how many.
std::size_t CliqueSearch::colour(const std::uint64_t* open) {
  const std::size_t words = subgraph_.words();
  const std::size_t first = branches_.size();
  std::copy(open, open + words, uncoloured_.begin());
  std::int64_t bound = 0;
  while (any(uncoloured_.data(), words)) {
    std::int64_t heaviest = 0;
    colour_class_ = uncoloured_;
    for (std::size_t w = 0; w < words; ++w) {
      while (colour_class_[w] != 0) {
        const auto v = w * 64 + static_cast<std::size_t>(std::countr_zero(colour_class_[w]));
        heaviest = std::max(heaviest, weight_[v]);
        branches_.push_back({static_cast<int>(v), bound + heaviest});
        uncoloured_[w] &= ~bit(v);
        colour_class_[w] &= ~bit(v);
        for (std::size_t rest = w; rest < words; ++rest) {
          colour_class_[rest] &= ~subgraph_.row(v)[rest];
        }
      }
    }
    bound += heaviest;
  }
  return branches_.size() - first;
}

void CliqueSearch::expand(std::size_t depth, std::int64_t weight) {
  if (calls_ >= max_calls_) {
    stopped_ = true;
    return;
  }
  ++calls_;
  const std::size_t words = subgraph_.words();
  if (open_.size() < (depth + 2) * words) open_.resize((depth + 2) * words);
  const std::size_t count = colour(open_.data() + depth * words);
  for (std::size_t i = 0; i < count && !stopped_; ++i) {
    const Branch branch = branches_.back();
    if (weight + branch.bound <= best_weight_) {
      branches_.resize(branches_.size() - (count - i));
      return;
    }
    branches_.pop_back();
    const auto v = static_cast<std::size_t>(branch.vertex);
    current_.push_back(branch.vertex);
    std::uint64_t* open = open_.data() + depth * words;
    std::uint64_t* next = open + words;
    intersect(open, subgraph_.row(v), words, next);
    open[v / 64] &= ~bit(v);
    if (any(next, words)) {
      expand(depth + 1, weight + weight_[v]);
    } else {
      record(weight + weight_[v]);
    }
    current_.pop_back();
  }
}

void CliqueSearch::record(std::int64_t weight) {
  if (weight <= best_weight_) return;
  best_weight_ = weight;
  best_.clear();
  for (const int position : current_) best_.push_back(order_[static_cast<std::size_t>(position)]);
}

}  // namespace adit
