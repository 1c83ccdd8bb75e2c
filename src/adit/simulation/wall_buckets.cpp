#include "adit/simulation/wall_buckets.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace adit {
namespace {

constexpr double kMostBuckets = 4e6;

bool do_cross(const Segment& s, const Segment& t) {
  const auto side = [](const Segment& line, const Vector2d& p) {
    return cross(line.b - line.a, p - line.a);
  };
  return side(s, t.a) * side(s, t.b) < 0.0 && side(t, s.a) * side(t, s.b) < 0.0;
}

/// Where two pieces do not cross, an end of one of them is nearest.
double distance(const Segment& s, const Segment& t) {
  if (do_cross(s, t)) return 0.0;
  return std::min({distance(s, t.a), distance(s, t.b), distance(t, s.a), distance(t, s.b)});
}

}  // namespace

WallBuckets::WallBuckets(std::span<const Segment> walls) {
  std::copy_if(walls.begin(), walls.end(), std::back_inserter(walls_),
               [](const Segment& wall) { return wall.is_finite(); });
  if (walls_.empty()) return;
  corner_ = far_ = walls_.front().a;
  for (const Segment& wall : walls_) {
    corner_ = corner_.cwiseMin(wall.a).cwiseMin(wall.b);
    far_ = far_.cwiseMax(wall.a).cwiseMax(wall.b);
  }
  const Vector2d size = far_ - corner_;
  bucket_m_ = std::max({1.0, std::sqrt(size.x() * size.y() / kMostBuckets),
                        std::max(size.x(), size.y()) / kMostBuckets});
  columns_ = static_cast<int>(size.x() / bucket_m_) + 1;
  rows_ = static_cast<int>(size.y() / bucket_m_) + 1;
  first_in_bucket_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1,
                          0);
  for (const Segment& wall : walls_) {
    visit_buckets(wall, 0.0, [&](std::size_t bucket) { ++first_in_bucket_[bucket + 1]; });
  }
  for (std::size_t i = 1; i < first_in_bucket_.size(); ++i) {
    first_in_bucket_[i] += first_in_bucket_[i - 1];
  }
  entries_.resize(static_cast<std::size_t>(first_in_bucket_.back()));
  std::vector<int> next(first_in_bucket_);
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    visit_buckets(walls_[i], 0.0, [&](std::size_t bucket) {
      entries_[static_cast<std::size_t>(next[bucket]++)] = static_cast<int>(i);
    });
  }
}

int WallBuckets::column(double x) const {
  const double at = std::floor((x - corner_.x()) / bucket_m_);
  return static_cast<int>(std::clamp(at, 0.0, columns_ - 1.0));
}

int WallBuckets::row(double y) const {
  const double at = std::floor((y - corner_.y()) / bucket_m_);
  return static_cast<int>(std::clamp(at, 0.0, rows_ - 1.0));
}

/// The buckets within the margin of a segment, row by row.
template <class Visit>
void WallBuckets::visit_buckets(const Segment& segment, double margin, Visit&& visit) const {
  constexpr double kRounding = 1e-9;
  const Segment s = segment.a.y() <= segment.b.y() ? segment : Segment{segment.b, segment.a};
  const Vector2d along = s.b - s.a;
  const int last = row(s.b.y() + margin);
  for (int r = row(s.a.y() - margin); r <= last; ++r) {
    const double low = corner_.y() + r * bucket_m_ - margin;
    const double high = low + bucket_m_ + 2.0 * margin;
    const auto part = [&](double y) { return std::clamp((y - s.a.y()) / along.y(), 0.0, 1.0); };
    double x1 = s.a.x();
    double x2 = s.b.x();
    if (along.y() > kRounding) {
      x1 = s.a.x() + part(low) * along.x();
      x2 = s.a.x() + part(high) * along.x();
    }
    const int end = column(std::max(x1, x2) + margin + kRounding);
    for (int c = column(std::min(x1, x2) - margin - kRounding); c <= end; ++c) {
      visit(static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
            static_cast<std::size_t>(c));
    }
  }
}

double WallBuckets::clearance(const Segment& piece, double reach) const {
  double nearest = reach;
  if (walls_.empty()) return nearest;
  visit_buckets(piece, reach, [&](std::size_t bucket) {
    const auto begin = static_cast<std::size_t>(first_in_bucket_[bucket]);
    const auto end = static_cast<std::size_t>(first_in_bucket_[bucket + 1]);
    for (std::size_t i = begin; i < end; ++i) {
      nearest = std::min(nearest, distance(walls_[static_cast<std::size_t>(entries_[i])], piece));
    }
  });
  return nearest;
}

}  // namespace adit
