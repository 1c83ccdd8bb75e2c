#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "adit/map/box.hpp"

namespace adit {

/// A static packed R-tree (Kamel & Faloutsos, VLDB 1994) over segments.
///
/// Why this one: it adapts to any distribution (a grid needs one cell size for the dense panel and
/// the lone exploration drift), it is two flat arrays that are built in one linear pass, and where
/// the segments come in Hilbert order a query reads memory that lies together, so that its cost
/// depends on what is near and not on the size of the mine. Long segments are cut into pieces for
/// the index only: one boundary line across the mine would otherwise swell the boxes above it.
///
/// The index keeps no segments; the caller tests those that a visit offers.
class SegmentIndex {
 public:
  /// One piece of a segment: number `piece` of `pieces` equal ones.
  struct Entry {
    int segment = 0;
    int piece = 0;
    int pieces = 1;

    /// True for exactly one piece of the segment: that with the point at `fraction` of its length.
    bool holds(double fraction) const {
      if (pieces == 1) return true;
      const int at = static_cast<int>(fraction * pieces);
      return piece == (at < pieces ? at : pieces - 1);
    }
  };

  SegmentIndex() = default;
  /// Any order of finite segments is correct; Hilbert order is fast.
  explicit SegmentIndex(std::span<const Segment> segments);

  /// Box around everything; empty for no segments.
  Box bounds() const { return boxes_.empty() ? Box{} : boxes_.back(); }

  /// Calls `take(entry)` in the order of the entries for all below boxes with `reaches(box)`, which
  /// must hold for a box whenever it holds for a box inside of it.
  template <class Reaches, class Take>
  void visit(const Reaches& reaches, const Take& take) const {
    visit_leaves(reaches, [&](std::size_t leaf) {
      for (const Entry& entry : entries_of(leaf)) take(entry);
    });
  }

  /// Calls `take(i, j)`, i < j, for each pair of segments whose boxes come within `margin` (m) of
  /// each other; a pair of long ones may come more than once. `segments` are those of the build.
  template <class Take>
  void visit_close_pairs(std::span<const Segment> segments, double margin, const Take& take) const {
    for (std::size_t leaf = 0; leaf < leaf_count(); ++leaf) {
      const Box around = boxes_[leaf].padded(margin);
      const PieceBoxes own = piece_boxes(segments, leaf, margin);
      visit_leaves([&](const Box& box) { return box.overlaps(around); },
                   [&](std::size_t other) {
                     if (other < leaf) return;
                     const PieceBoxes theirs = piece_boxes(segments, other, 0.0);
                     visit_pairs(leaf, own, other, theirs, take);
                   });
    }
  }

 private:
  static constexpr std::size_t kFanOut = 8;
  using PieceBoxes = std::array<Box, kFanOut>;

  std::size_t leaf_count() const { return (entries_.size() + kFanOut - 1) / kFanOut; }
  std::span<const Entry> entries_of(std::size_t leaf) const {
    const std::size_t begin = leaf * kFanOut;
    return {entries_.data() + begin, std::min(kFanOut, entries_.size() - begin)};
  }
  PieceBoxes piece_boxes(std::span<const Segment> segments, std::size_t leaf, double margin) const;
  void add_entries(std::span<const Segment> segments);
  void sort_entries(std::span<const Segment> segments);
  void add_boxes(std::span<const Segment> segments);

  template <class Reaches, class TakeLeaf>
  void visit_leaves(const Reaches& reaches, const TakeLeaf& take) const {
    if (!boxes_.empty()) descend(level_begin_.size() - 1, 0, reaches, take);
  }

  template <class Reaches, class TakeLeaf>
  void descend(std::size_t level, std::size_t node, const Reaches& reaches,
               const TakeLeaf& take) const {
    if (!reaches(boxes_[level_begin_[level] + node])) return;
    if (level == 0) return take(node);
    const std::size_t below = level_begin_[level] - level_begin_[level - 1];
    const std::size_t end = std::min((node + 1) * kFanOut, below);
    for (std::size_t child = node * kFanOut; child < end; ++child) {
      descend(level - 1, child, reaches, take);
    }
  }

  template <class Take>
  void visit_pairs(std::size_t leaf, const PieceBoxes& own, std::size_t other,
                   const PieceBoxes& theirs, const Take& take) const {
    const auto a = entries_of(leaf);
    const auto b = entries_of(other);
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = leaf == other ? i + 1 : 0; j < b.size(); ++j) {
        if (!own[i].overlaps(theirs[j]) || a[i].segment == b[j].segment) continue;
        take(std::min(a[i].segment, b[j].segment), std::max(a[i].segment, b[j].segment));
      }
    }
  }

  std::vector<Entry> entries_;
  std::vector<Box> boxes_;  // leaves first, then level upon level, the root last
  std::vector<std::size_t> level_begin_;
};

}  // namespace adit
