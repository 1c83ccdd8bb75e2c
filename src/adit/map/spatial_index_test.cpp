#include "adit/map/spatial_index.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>

#include "adit/map/hilbert.hpp"
#include "support/draws.hpp"

namespace adit {
namespace {

std::vector<Segment> scattered(int count, std::uint64_t seed, int one_in_long) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0.0, 100.0);
  std::uniform_real_distribution<double> step(-2.0, 2.0);
  std::vector<Segment> segments;
  for (int i = 0; i < count; ++i) {
    const Vector2d from = test::drawn<2>([&] { return place(random); });
    const Vector2d by = test::drawn<2>([&] { return step(random); });
    segments.push_back({from, from + (i % one_in_long == 0 ? 40.0 : 1.0) * by});
  }
  return segments;
}

TEST(SegmentIndex, of_nothing_visits_nothing) {
  int visits = 0;
  const auto count = [&](const auto&...) { ++visits; };
  SegmentIndex{}.visit([](const Box&) { return true; }, count);
  const SegmentIndex index(std::span<const Segment>{});
  index.visit([](const Box&) { return true; }, count);
  index.visit_close_pairs({}, 1.0, count);
  EXPECT_EQ(visits, 0);
  EXPECT_TRUE(index.bounds().is_empty());
}

TEST(SegmentIndex, visits_each_piece_once) {
  for (const int count : {1, 7, 8, 9, 64, 65, 513, 2000}) {
    const auto segments = scattered(count, 5, 10);
    const SegmentIndex index(segments);
    std::set<std::pair<int, int>> seen;
    std::vector<int> pieces(segments.size(), 0);
    index.visit([](const Box&) { return true; },
                [&](const SegmentIndex::Entry& entry) {
                  EXPECT_TRUE(seen.insert({entry.segment, entry.piece}).second);
                  EXPECT_LT(entry.piece, entry.pieces);
                  pieces[static_cast<std::size_t>(entry.segment)] = entry.pieces;
                });
    std::size_t total = 0;
    for (const int of_one : pieces) {
      EXPECT_GE(of_one, 1);
      total += static_cast<std::size_t>(of_one);
    }
    EXPECT_EQ(seen.size(), total);
    EXPECT_LE(total, 2 * segments.size()) << "long segments fill the index";
  }
}

TEST(SegmentIndex, exactly_one_piece_holds_a_point) {
  for (const double fraction : {0.0, 0.2, 1.0 / 3.0, 0.5, 0.999999, 1.0}) {
    for (const int pieces : {1, 2, 3, 10}) {
      int holding = 0;
      for (int piece = 0; piece < pieces; ++piece) {
        holding += SegmentIndex::Entry{0, piece, pieces}.holds(fraction) ? 1 : 0;
      }
      EXPECT_EQ(holding, 1) << fraction << " of " << pieces;
    }
  }
}

TEST(SegmentIndex, finds_every_pair_that_is_near) {
  constexpr double kMargin = 0.5;
  const auto segments = scattered(600, 11, 10);
  std::set<std::pair<int, int>> found;
  SegmentIndex(segments).visit_close_pairs(segments, kMargin, [&](int i, int j) {
    EXPECT_LT(i, j);
    found.insert({i, j});
  });
  std::size_t near = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (std::size_t j = i + 1; j < segments.size(); ++j) {
      double gap = 1e9;
      for (int k = 0; k <= 40; ++k) {
        const Vector2d point = segments[i].a + (segments[i].b - segments[i].a) * (k / 40.0);
        gap = std::min(gap, distance(segments[j], point));
      }
      if (gap > kMargin) continue;
      ++near;
      EXPECT_TRUE(found.contains({static_cast<int>(i), static_cast<int>(j)})) << i << " " << j;
    }
  }
  EXPECT_GT(near, 100U);
  EXPECT_LT(found.size(), 20 * near) << "far pairs are not to be looked at";
}

// The reason for the pieces: lines across the whole plan must not spoil the search elsewhere.
TEST(SegmentIndex, long_segments_do_not_swell_the_search) {
  std::vector<Segment> segments;
  for (int x = 0; x < 100; ++x) {
    for (int y = 0; y < 100; ++y) segments.push_back({{x + 0.1, y + 0.1}, {x + 0.9, y + 0.1}});
  }
  const auto boxes_visited = [](std::vector<Segment> unsorted) {
    std::vector<Segment> sorted;
    for (const int i : hilbert_order(unsorted)) {
      sorted.push_back(unsorted[static_cast<std::size_t>(i)]);
    }
    const SegmentIndex index(sorted);
    int boxes = 0;
    for (int k = 0; k < 50; ++k) {
      const Vector2d center(5.0 + 1.8 * k, 80.0 - 1.3 * k);
      index.visit([&](const Box& box) { return ++boxes, box.squared_distance(center) <= 9.0; },
                  [](const SegmentIndex::Entry&) {});
    }
    return boxes;
  };
  const int without = boxes_visited(segments);
  for (int k = 0; k < 50; ++k) segments.push_back({{1.6 * k, 0.0}, {1.6 * k + 20.0, 100.0}});
  EXPECT_LT(boxes_visited(segments), 1.25 * without);  // 1.6 if the boxes held them whole
}

}  // namespace
}  // namespace adit
