#include "adit/visibility/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "adit/visibility/bearing_key.hpp"

namespace adit {
namespace {

using Piece = Envelope::Piece;

void append(const Piece& piece, std::vector<Piece>& out) {
  if (!out.empty() && out.back().wall == piece.wall && out.back().end == piece.begin) {
    out.back().end = piece.end;
  } else {
    out.push_back(piece);
  }
}

Piece cut_before(const Piece& piece, double key) {
  return {std::max(piece.begin, key), piece.end, piece.wall};
}

/// Positive where `a` is nearer along the direction, negative where `b` is, 0 where rounding cannot
/// tell, as at a vertex that both share.
double lead(const SweptWall& a, const SweptWall& b, const Vector2d& direction) {
  const double inverse_a = cross(direction, a.inverse_range);
  const double inverse_b = cross(direction, b.inverse_range);
  const double difference = inverse_a - inverse_b;
  const double doubt = (a.rounding + b.rounding) * std::max(inverse_a, inverse_b);
  return std::abs(difference) <= doubt ? 0.0 : difference;
}

}  // namespace

void Envelope::clear() {
  walls_.clear();
  pieces_.clear();
  staged_.clear();
}

void Envelope::stage(const SweptWall& wall) {
  const int index = static_cast<int>(walls_.size());
  walls_.push_back(wall);
  if (wall.begin_key < wall.end_key) {
    staged_.push_back({wall.begin_key, wall.end_key, index});
  } else {  // it spans the bearing pi
    staged_.push_back({wall.begin_key, 2.0, index});
    staged_.push_back({-2.0, wall.end_key, index});
  }
}

void Envelope::merge_staged() {
  if (staged_.empty()) return;
  std::sort(staged_.begin(), staged_.end(), [](const Piece& a, const Piece& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.wall < b.wall;
  });
  split_into_runs();
  while (run_ends_.size() > 1) {
    merged_.clear();
    std::size_t runs = 0;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < run_ends_.size(); i += 2) {
      const std::size_t middle = run_ends_[i];
      const std::size_t end = i + 1 < run_ends_.size() ? run_ends_[i + 1] : middle;
      const std::span<const Piece> all(staged_);
      merge(all.subspan(begin, middle - begin), all.subspan(middle, end - middle), merged_);
      run_ends_[runs++] = merged_.size();
      begin = end;
    }
    run_ends_.resize(runs);
    std::swap(staged_, merged_);
  }
  if (pieces_.empty()) {
    std::swap(pieces_, staged_);
  } else {
    merged_.clear();
    merge(pieces_, staged_, merged_);
    std::swap(pieces_, merged_);
  }
  staged_.clear();
}

// Neighbours that do not overlap are an envelope already.
void Envelope::split_into_runs() {
  run_ends_.clear();
  for (std::size_t i = 1; i < staged_.size(); ++i) {
    if (staged_[i].begin < staged_[i - 1].end) run_ends_.push_back(i);
  }
  run_ends_.push_back(staged_.size());
}

void Envelope::merge(std::span<const Piece> a, std::span<const Piece> b,
                     std::vector<Piece>& out) const {
  std::size_t i = 0;
  std::size_t j = 0;
  double done = -2.0;
  while (i < a.size() && j < b.size()) {
    const Piece x = cut_before(a[i], done);
    const Piece y = cut_before(b[j], done);
    if (x.end <= y.begin) {
      append(x, out);
      ++i;
    } else if (y.end <= x.begin) {
      append(y, out);
      ++j;
    } else {
      const double both = std::max(x.begin, y.begin);
      if (x.begin < both) append({x.begin, both, x.wall}, out);
      if (y.begin < both) append({y.begin, both, y.wall}, out);
      done = std::min(x.end, y.end);
      append_nearer(both, done, x.wall, y.wall, out);
      if (x.end == done) ++i;
      if (y.end == done) ++j;
    }
  }
  for (; i < a.size(); ++i) append(cut_before(a[i], done), out);
  for (; j < b.size(); ++j) append(cut_before(b[j], done), out);
}

// 1 / range is linear in the direction, so two walls swap places at most once.
void Envelope::append_nearer(double begin, double end, int a, int b,
                             std::vector<Piece>& out) const {
  const SweptWall& wall_a = wall(a);
  const SweptWall& wall_b = wall(b);
  const double at_begin = lead(wall_a, wall_b, key_direction(begin));
  const double at_end = lead(wall_a, wall_b, key_direction(end));
  if (at_begin * at_end >= 0.0) {
    const double sum = at_begin + at_end;
    const bool a_wins = sum != 0.0 ? sum > 0.0 : wall_a.wall < wall_b.wall;
    append({begin, end, a_wins ? a : b}, out);
    return;
  }
  Vector2d crossing = wall_a.inverse_range - wall_b.inverse_range;
  if (at_begin < 0.0) crossing = -crossing;  // at_begin is its cross product with the begin
  const double key = std::clamp(bearing_key(crossing), begin, end);
  if (begin < key) append({begin, key, at_begin > 0.0 ? a : b}, out);
  if (key < end) append({key, end, at_end > 0.0 ? a : b}, out);
}

std::size_t Envelope::sector(double key) {
  const double position = (key + 2.0) * (static_cast<double>(kSectors) / 4.0);
  return std::min(static_cast<std::size_t>(position), kSectors - 1);
}

double Envelope::squared_range_at(int index, double key) const {
  const Vector2d direction = key_direction(key);
  const double inverse = cross(direction, wall(index).inverse_range);
  return direction.squaredNorm() / (inverse * inverse);
}

void Envelope::raise_reach(double begin, double end, double squared_distance) {
  for (std::size_t s = sector(begin); s <= sector(end); ++s) {
    squared_reach_[s] = std::max(squared_reach_[s], squared_distance);
  }
}

void Envelope::measure_reach() {
  constexpr double kOpen = std::numeric_limits<double>::infinity();
  squared_reach_.fill(0.0);
  double done = -2.0;
  for (const Piece& piece : pieces_) {
    if (piece.begin > done) raise_reach(done, piece.begin, kOpen);
    const double farthest = std::max(squared_range_at(piece.wall, piece.begin),
                                     squared_range_at(piece.wall, piece.end));
    raise_reach(piece.begin, piece.end, farthest);
    done = piece.end;
  }
  if (done < 2.0) raise_reach(done, 2.0, kOpen);
  reach_ = std::sqrt(*std::max_element(squared_reach_.begin(), squared_reach_.end()));
}

bool Envelope::hides(const SweptWall& wall, double squared_distance) const {
  const std::size_t last = sector(wall.end_key);
  for (std::size_t s = sector(wall.begin_key);; s = s + 1 < kSectors ? s + 1 : 0) {
    if (squared_reach_[s] >= squared_distance) return false;
    if (s == last) return true;
  }
}

}  // namespace adit
