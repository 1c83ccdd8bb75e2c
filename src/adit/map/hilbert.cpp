#include "adit/map/hilbert.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "adit/map/box.hpp"

namespace adit {

namespace {

constexpr int kBits = 4;  // of each coordinate that one look into the table deals with
constexpr std::uint32_t kCells = 1U << (2 * kBits);

// How the curve runs through a square: transposed, or turned by half a circle, or both.
struct Course {
  bool transposed = false;
  bool turned = false;
};

// For each course through a square and each of its 16 x 16 cells: the cell's number along the curve
// in the low byte, the course through the cell above it.
constexpr std::uint16_t follow_curve(Course course, std::uint32_t x, std::uint32_t y) {
  std::uint32_t number = 0;
  for (int bit = kBits - 1; bit >= 0; --bit) {
    std::uint32_t right = ((x >> bit) & 1U) ^ (course.turned ? 1U : 0U);
    std::uint32_t upper = ((y >> bit) & 1U) ^ (course.turned ? 1U : 0U);
    if (course.transposed) std::swap(right, upper);
    number = (number << 2) | ((3U * right) ^ upper);
    if (upper == 0U) {  // the lower two quadrants hold transposed copies, the right one also turned
      course.transposed = !course.transposed;
      if (right == 1U) course.turned = !course.turned;
    }
  }
  const std::uint32_t next = (course.transposed ? 1U : 0U) | (course.turned ? 2U : 0U);
  return static_cast<std::uint16_t>(number | (next << (2 * kBits)));
}

using CurveTable = std::array<std::uint16_t, 4 * kCells>;

constexpr CurveTable make_curve_table() {
  CurveTable table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    const std::uint32_t cell = i % kCells;
    const Course course{((i / kCells) & 1U) != 0U, ((i / kCells) & 2U) != 0U};
    table[i] = follow_curve(course, cell >> kBits, cell & ((1U << kBits) - 1U));
  }
  return table;
}

constexpr CurveTable kCurve = make_curve_table();

}  // namespace

std::uint64_t hilbert_key(std::uint32_t x, std::uint32_t y) {
  constexpr std::uint32_t kMask = (1U << kBits) - 1U;
  std::uint64_t key = 0;
  std::uint32_t course = 0;
  for (int shift = 32 - kBits; shift >= 0; shift -= kBits) {
    const std::uint32_t cell = (((x >> shift) & kMask) << kBits) | ((y >> shift) & kMask);
    const std::uint32_t entry = kCurve[course * kCells + cell];
    key = (key << (2 * kBits)) | (entry & (kCells - 1U));
    course = entry >> (2 * kBits);
  }
  return key;
}

std::vector<int> hilbert_order(std::span<const Segment> segments) {
  Box bounds;
  for (const Segment& s : segments) bounds.extend(Vector2d(0.5 * (s.a + s.b)));
  // One scale for both axes; 32 bits keep metres apart even beside a wall at the other end of the
  // world. The scale stays just below 2^32 so that the cast cannot overflow.
  const double extent = bounds.size().maxCoeff();
  const double scale = extent > 0.0 ? 4294967295.0 / extent : 0.0;

  std::vector<std::pair<std::uint64_t, int>> keyed(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Vector2d cell = (0.5 * (segments[i].a + segments[i].b) - bounds.min) * scale;
    const auto x = static_cast<std::uint32_t>(std::clamp(cell.x(), 0.0, 4294967295.0));
    const auto y = static_cast<std::uint32_t>(std::clamp(cell.y(), 0.0, 4294967295.0));
    keyed[i] = {hilbert_key(x, y), static_cast<int>(i)};
  }
  std::sort(keyed.begin(), keyed.end());

  std::vector<int> order(keyed.size());
  std::transform(keyed.begin(), keyed.end(), order.begin(),
                 [](const auto& entry) { return entry.second; });
  return order;
}

}  // namespace adit
