#include "adit/map/spatial_index.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "adit/map/hilbert.hpp"

namespace adit {
namespace {

// A wall that runs away to the horizon must not fill the index with its pieces.
constexpr double kMaxPieces = 1024.0;
// Boxes are a little larger than their pieces, so that a query that just touches a segment by the
// rounding of one formula does not miss its box by the rounding of another.
constexpr double kRelativePadding = 1e-12;

double piece_count(double length, double piece_length) {
  return piece_length > 0.0 ? std::clamp(std::ceil(length / piece_length), 1.0, kMaxPieces) : 1.0;
}

// Four typical segments long, or more where that would make more than one extra piece a segment.
double choose_piece_length(std::vector<double> lengths) {
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  double piece_length = 4.0 * *middle;
  const auto total = [&] {
    double sum = 0.0;
    for (const double length : lengths) sum += piece_count(length, piece_length);
    return sum;
  };
  while (piece_length > 0.0 && total() > 2.0 * static_cast<double>(lengths.size())) {
    piece_length *= 2.0;
  }
  return piece_length;
}

Segment piece_of(const Segment& s, const SegmentIndex::Entry& entry) {
  if (entry.pieces == 1) return s;
  const Vector2d step = (s.b - s.a) / entry.pieces;
  return {s.a + step * entry.piece, s.a + step * (entry.piece + 1)};
}

}  // namespace

SegmentIndex::SegmentIndex(std::span<const Segment> segments) {
  if (segments.empty()) return;
  add_entries(segments);
  add_boxes(segments);
}

void SegmentIndex::add_entries(std::span<const Segment> segments) {
  std::vector<double> lengths(segments.size());
  std::transform(segments.begin(), segments.end(), lengths.begin(),
                 [](const Segment& s) { return s.length(); });
  const double piece_length = choose_piece_length(lengths);

  entries_.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const int count = static_cast<int>(piece_count(lengths[i], piece_length));
    for (int piece = 0; piece < count; ++piece) {
      entries_.push_back({static_cast<int>(i), piece, count});
    }
  }
  if (entries_.size() > segments.size()) sort_entries(segments);
}

// Puts each piece of a long segment among its neighbours.
void SegmentIndex::sort_entries(std::span<const Segment> segments) {
  std::vector<Segment> pieces(entries_.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    pieces[i] = piece_of(segments[static_cast<std::size_t>(entries_[i].segment)], entries_[i]);
  }
  std::vector<Entry> sorted;
  sorted.reserve(entries_.size());
  for (const int i : hilbert_order(pieces)) {
    sorted.push_back(entries_[static_cast<std::size_t>(i)]);
  }
  entries_ = std::move(sorted);
}

void SegmentIndex::add_boxes(std::span<const Segment> segments) {
  for (std::size_t leaf = 0; leaf < leaf_count(); ++leaf) {
    Box around;
    for (const Entry& entry : entries_of(leaf)) {
      around.extend(box_of(piece_of(segments[static_cast<std::size_t>(entry.segment)], entry)));
    }
    const double largest =
        std::max(around.min.cwiseAbs().maxCoeff(), around.max.cwiseAbs().maxCoeff());
    boxes_.push_back(around.padded(kRelativePadding * (1.0 + largest)));
  }
  level_begin_ = {0};
  while (boxes_.size() - level_begin_.back() > 1) {
    const std::size_t begin = level_begin_.back();
    const std::size_t end = boxes_.size();
    level_begin_.push_back(end);
    for (std::size_t first = begin; first < end; first += kFanOut) {
      Box around;
      for (std::size_t i = first; i < std::min(first + kFanOut, end); ++i) around.extend(boxes_[i]);
      boxes_.push_back(around);
    }
  }
}

SegmentIndex::PieceBoxes SegmentIndex::piece_boxes(std::span<const Segment> segments,
                                                   std::size_t leaf, double margin) const {
  PieceBoxes boxes;
  const auto entries = entries_of(leaf);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Segment& segment = segments[static_cast<std::size_t>(entries[i].segment)];
    boxes[i] = box_of(piece_of(segment, entries[i])).padded(margin);
  }
  return boxes;
}

}  // namespace adit
