#include "adit/plot/page_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <utility>

namespace adit {
namespace {

constexpr double kCell = 0.05;  // points: two thousandths of a millimetre

/// Narrows [from, to] of p(t) = a + t d to lower <= p <= upper in one axis (Liang & Barsky 1984).
bool clip_axis(double a, double d, double lower, double upper, double& from, double& to) {
  if (d == 0.0) return a >= lower && a <= upper;
  double enter = (lower - a) / d;
  double leave = (upper - a) / d;
  if (enter > leave) std::swap(enter, leave);
  from = std::max(from, enter);
  to = std::min(to, leave);
  return from <= to;
}

std::optional<std::pair<Vector2d, Vector2d>> clip(const Vector2d& a, const Vector2d& b,
                                                  const PageRect& window) {
  const Vector2d d = b - a;
  double from = 0.0;
  double to = 1.0;
  if (!clip_axis(a.x(), d.x(), window.min.x(), window.max().x(), from, to)) return std::nullopt;
  if (!clip_axis(a.y(), d.y(), window.min.y(), window.max().y(), from, to)) return std::nullopt;
  return std::pair(from == 0.0 ? a : Vector2d(a + from * d), to == 1.0 ? b : Vector2d(a + to * d));
}

/// Builds the path of the page edge by edge.
class Reducer {
 public:
  explicit Reducer(const PageRect& window) : window_(window) {}

  void begin() { open_ = false; }

  void edge(const Vector2d& a, const Vector2d& b) {
    const auto visible = clip(a, b, window_);
    if (!visible || already_drawn(visible->first, visible->second)) {
      open_ = false;
      return;
    }
    if (!open_ || out_.points.back() != visible->first) {
      out_.begin();
      out_.points.push_back(visible->first);
    }
    out_.points.push_back(visible->second);
    open_ = visible->second == b;
  }

  PathPoints take() { return std::move(out_); }

 private:
  std::int64_t cell(double value) const { return std::llround(value / kCell); }
  std::uint64_t key(const Vector2d& p) const {
    return static_cast<std::uint64_t>(cell(p.x())) << 32U ^
           (static_cast<std::uint64_t>(cell(p.y())) & 0xffffffffU);
  }
  bool already_drawn(const Vector2d& a, const Vector2d& b) {
    std::uint64_t first = key(a);
    std::uint64_t second = key(b);
    if (first > second) std::swap(first, second);
    return !drawn_.insert(Ends{first, second}).second;
  }

  using Ends = std::pair<std::uint64_t, std::uint64_t>;
  struct EndsHash {
    std::size_t operator()(const Ends& ends) const {
      constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15U;
      return static_cast<std::size_t>((ends.first * kOdd ^ ends.second) * kOdd >> 7U);
    }
  };

  PageRect window_;
  PathPoints out_;
  bool open_ = false;
  std::unordered_set<Ends, EndsHash> drawn_;
};

}  // namespace

PathPoints to_page(const PathPoints& world, const WorldToPage& map, const PageRect& window) {
  Reducer reducer(window);
  for (std::size_t i = 0; i < world.count(); ++i) {
    const std::span<const Vector2d> part = world.part(i);
    reducer.begin();
    std::optional<Vector2d> last;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Vector2d p = map(part[k]);
      if (!p.allFinite()) {
        last.reset();
        reducer.begin();
        continue;
      }
      const bool is_last = k + 1 == part.size();
      if (last && !is_last && (p - *last).squaredNorm() < kCell * kCell) continue;
      if (last) reducer.edge(*last, p);
      last = p;
    }
  }
  return reducer.take();
}

}  // namespace adit
