#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "adit/matching/chain_search.hpp"
#include "adit/matching/clique_search.hpp"
#include "adit/matching/compatibility.hpp"

// Both searches against the enumeration of all subsets.

namespace adit {
namespace {

constexpr int kUnlimited = 1 << 30;

struct Problem {
  BitMatrix graph;
  std::vector<std::int64_t> weights;
  std::vector<int> ranks;
  int lap = 0;
};

Problem random_problem(std::mt19937_64& random, int most) {
  const auto below = [&](int limit) { return static_cast<int>(random() % limit); };
  Problem problem;
  const int size = below(most + 1);
  const int density = 10 + below(90);
  problem.graph.reset(static_cast<std::size_t>(size));
  problem.lap = 1 + below(8);
  int rank = below(3);
  for (int i = 0; i < size; ++i) {
    problem.weights.push_back(kPairWeight + below(1000));
    rank += below(4) - 1;
    problem.ranks.push_back(rank);
    for (int j = 0; j < i; ++j) {
      if (below(100) < density) problem.graph.set_both(i, j);
    }
  }
  return problem;
}

std::int64_t weight_of(const Problem& problem, std::span<const int> set) {
  std::int64_t weight = 0;
  for (const int i : set) weight += problem.weights[static_cast<std::size_t>(i)];
  return weight;
}

bool is_clique(const Problem& problem, std::span<const int> set) {
  for (std::size_t i = 0; i < set.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!problem.graph.test(set[i], set[j])) return false;
    }
  }
  return true;
}

bool is_cyclic_chain(const Problem& problem, std::span<const int> set) {
  const std::size_t size = set.size();
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t back = 1; back <= 2; ++back) {
      const std::size_t before = (i + 2 * size - back) % size;
      if (before != i && !problem.graph.test(set[i], set[before])) return false;
    }
    if (i > 0 && problem.ranks[set[i]] < problem.ranks[set[i - 1]]) return false;
  }
  return size == 0 || problem.ranks[set.back()] - problem.ranks[set.front()] <= problem.lap;
}

template <class Predicate>
std::int64_t heaviest_subset(const Problem& problem, Predicate&& consistent) {
  std::int64_t best = 0;
  std::vector<int> set;
  for (std::uint32_t mask = 0; mask < (1u << problem.weights.size()); ++mask) {
    set.clear();
    for (std::uint32_t rest = mask; rest != 0; rest &= rest - 1) {
      set.push_back(std::countr_zero(rest));
    }
    const std::int64_t weight = weight_of(problem, set);
    if (weight > best && consistent(problem, set)) best = weight;
  }
  return best;
}

TEST(CliqueSearch, FindsTheMaximumOfAllSubsets) {
  std::mt19937_64 random(1);
  CliqueSearch search;
  for (int i = 0; i < 1500; ++i) {
    const Problem problem = random_problem(random, i < 1400 ? 10 : 14);
    const auto found = search.find(problem.graph, problem.weights, kUnlimited);
    ASSERT_TRUE(search.is_maximum());
    ASSERT_TRUE(is_clique(problem, found));
    ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
    ASSERT_EQ(weight_of(problem, found), heaviest_subset(problem, is_clique)) << "case " << i;
  }
}

TEST(ChainSearch, FindsTheMaximumOfAllSubsets) {
  std::mt19937_64 random(2);
  ChainSearch search;
  for (int i = 0; i < 1500; ++i) {
    const Problem problem = random_problem(random, i < 1400 ? 10 : 14);
    const auto found =
        search.find(problem.graph, problem.ranks, problem.lap, problem.weights, kUnlimited);
    ASSERT_TRUE(search.is_maximum());
    ASSERT_TRUE(is_cyclic_chain(problem, found));
    ASSERT_EQ(weight_of(problem, found), heaviest_subset(problem, is_cyclic_chain)) << "case " << i;
  }
}

TEST(CliqueSearch, IsExactBeyondOneWord) {
  // A clique of 12 hidden in 200 vertices of sparse edges, which alone hold none so large.
  std::mt19937_64 random(3);
  Problem problem;
  problem.graph.reset(200);
  for (std::size_t i = 0; i < 200; ++i) {
    problem.weights.push_back(kPairWeight + static_cast<std::int64_t>(random() % 1000));
    for (std::size_t j = 0; j < i; ++j) {
      if (random() % 100 < 20 || (i % 17 == 3 && j % 17 == 3)) problem.graph.set_both(i, j);
    }
  }
  CliqueSearch search;
  const auto found = search.find(problem.graph, problem.weights, kUnlimited);
  ASSERT_TRUE(is_clique(problem, found));
  ASSERT_GE(found.size(), 12u);
  std::size_t hidden = 0;
  for (const int vertex : found) hidden += vertex % 17 == 3;
  EXPECT_EQ(hidden, 12u);
}

TEST(Searches, StopAtMaxCallsAndSaySo) {
  std::mt19937_64 random(4);
  Problem problem;
  problem.graph.reset(60);
  problem.lap = 1000;
  for (std::size_t i = 0; i < 60; ++i) {
    problem.weights.push_back(kPairWeight + static_cast<std::int64_t>(random() % 1000));
    problem.ranks.push_back(static_cast<int>(i));
    for (std::size_t j = 0; j < i; ++j) {
      if (random() % 100 < 70) problem.graph.set_both(i, j);
    }
  }
  CliqueSearch cliques;
  const std::size_t maximum = cliques.find(problem.graph, problem.weights, kUnlimited).size();
  const int needed = cliques.calls();
  ASSERT_GT(needed, 20);
  const auto cut = cliques.find(problem.graph, problem.weights, needed / 2);
  EXPECT_EQ(cliques.calls(), needed / 2);
  EXPECT_FALSE(cliques.is_maximum());
  EXPECT_TRUE(is_clique(problem, cut));
  EXPECT_GT(cut.size(), maximum / 2);
  cliques.find(problem.graph, problem.weights, needed);
  EXPECT_TRUE(cliques.is_maximum());

  ChainSearch chains;
  chains.find(problem.graph, problem.ranks, problem.lap, problem.weights, kUnlimited);
  EXPECT_TRUE(chains.is_maximum());
  const int calls = chains.calls();
  ASSERT_GT(calls, 3);
  const auto chain = chains.find(problem.graph, problem.ranks, problem.lap, problem.weights, 2);
  EXPECT_EQ(chains.calls(), 2);
  EXPECT_FALSE(chains.is_maximum());
  EXPECT_TRUE(is_cyclic_chain(problem, chain));
}

TEST(Searches, OfNothingFindNothing) {
  Problem problem;
  problem.graph.reset(0);
  CliqueSearch cliques;
  ChainSearch chains;
  EXPECT_TRUE(cliques.find(problem.graph, problem.weights, 10).empty());
  EXPECT_TRUE(chains.find(problem.graph, problem.ranks, 3, problem.weights, 10).empty());
  EXPECT_TRUE(cliques.is_maximum());
  EXPECT_TRUE(chains.is_maximum());
}

TEST(Searches, PreferSizeToReward) {
  Problem problem;
  problem.graph.reset(5);
  problem.lap = 10;
  problem.ranks = {0, 1, 2, 3, 4};
  problem.weights = {kPairWeight + 100000, kPairWeight + 100000, kPairWeight, kPairWeight,
                     kPairWeight};
  problem.graph.set_both(0, 1);
  problem.graph.set_both(2, 3);
  problem.graph.set_both(3, 4);
  problem.graph.set_both(2, 4);
  CliqueSearch cliques;
  ChainSearch chains;
  EXPECT_EQ(cliques.find(problem.graph, problem.weights, 100).size(), 3u);
  EXPECT_EQ(chains.find(problem.graph, problem.ranks, 10, problem.weights, 100).size(), 3u);
}

}  // namespace
}  // namespace adit
