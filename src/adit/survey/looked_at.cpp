#include "adit/survey/looked_at.hpp"

#include <algorithm>

namespace adit {

void extend_by_beams(const PosedScan& posed, const ScannerModel& scanner, Box& box) {
  const LaserScan& scan = posed.scan;
  const double none_from = scanner.no_return_from(scan.max_range);
  double longest = -1.0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (scan.has_return(i) && scan.ranges[i] < none_from) {
      longest = std::max(longest, scan.ranges[i]);
    }
  }
  if (longest < 0.0) return;
  const Vector2d laser = (posed.map_from_vehicle * scan.vehicle_from_laser).translation();
  // Around the laser whatever its heading: a little too much does no harm.
  box.extend(Box{laser, laser}.padded(longest));
}

std::optional<SegmentPart> stretch_within(const Segment& s, const Box& box) {
  const double length = s.length();
  if (length <= 0.0 || box.is_empty()) return std::nullopt;
  const Vector2d along = (s.b - s.a) / length;
  SegmentPart stretch{0.0, length};
  for (const int axis : {0, 1}) {
    const double to_low = box.min[axis] - s.a[axis];
    const double to_high = box.max[axis] - s.a[axis];
    if (along[axis] == 0.0) {
      if (to_low > 0.0 || to_high < 0.0) return std::nullopt;
      continue;
    }
    const double one = to_low / along[axis];
    const double other = to_high / along[axis];
    stretch.from_m = std::max(stretch.from_m, std::min(one, other));
    stretch.to_m = std::min(stretch.to_m, std::max(one, other));
  }
  if (stretch.to_m <= stretch.from_m) return std::nullopt;
  return stretch;
}

Segment piece_of(const Segment& s, const SegmentPart& stretch) {
  const double length = s.length();
  if (stretch.length_m() >= length) return s;
  const Vector2d along = (s.b - s.a) / length;
  return {s.a + stretch.from_m * along, s.a + stretch.to_m * along};
}

}  // namespace adit
