#include "adit/survey/station_sight.hpp"

#include <algorithm>
#include <cmath>

#include "adit/scan/returns.hpp"

namespace adit {
namespace {

constexpr std::size_t kSectors = 360;
constexpr double kLeastCosine = 0.2;  // flatter beams do not tell before from behind

std::size_t sector_of(double bearing) {
  const double share = wrap_positive(bearing) / kTwoPi;
  return std::min(kSectors - 1, static_cast<std::size_t>(share * static_cast<double>(kSectors)));
}

}  // namespace

void StationSight::add(const LaserScan& scan, double turn, const ScannerModel& scanner) {
  gathered_.resize(kSectors);
  const ReturnLimits limits = return_limits(scan, scanner);
  // A machine that turns carries its scanner about; all is told as seen from the first eye.
  const RigidTransform laser(Pose2{0.0, 0.0, turn} * scan.vehicle_from_laser);
  std::vector<float> nearest(kSectors, 0.0F);
  for (std::size_t i = 0; i < scan.beams_of_one_turn(); ++i) {
    const double range = scan.ranges[i];
    if (!limits.is_return(range)) continue;
    const Vector2d way = laser.point(range * unit_vector(scan.bearing(i))) - eye_;
    float& at = nearest[sector_of(std::atan2(way.y(), way.x()))];
    const auto here = static_cast<float>(way.norm());
    if (at == 0.0F || here < at) at = here;
  }
  for (std::size_t s = 0; s < kSectors; ++s) {
    if (nearest[s] > 0.0F) gathered_[s].push_back(nearest[s]);
  }
}

void StationSight::finish() {
  ranges_.assign(kSectors, 0.0);
  for (std::size_t s = 0; s < gathered_.size(); ++s) {
    std::vector<float>& of_scans = gathered_[s];
    if (of_scans.empty()) continue;
    const auto middle = of_scans.begin() + static_cast<std::ptrdiff_t>((of_scans.size() - 1) / 2);
    std::nth_element(of_scans.begin(), middle, of_scans.end());
    ranges_[s] = static_cast<double>(*middle);
  }
  gathered_.clear();
}

double StationSight::open_to(double bearing) const {
  const std::size_t sector = sector_of(bearing);
  double least = ranges_[sector];
  for (const std::size_t beside : {(sector + 1) % kSectors, (sector + kSectors - 1) % kSectors}) {
    if (ranges_[beside] > 0.0) least = std::min(least, ranges_[beside]);
  }
  return least;
}

double StationSight::share_seen_through(std::span<const StationPoint> points,
                                        const Pose2& sight_from_points, double through_m) const {
  if (is_empty() || points.empty()) return 0.0;
  const RigidTransform carry(sight_from_points);
  double through = 0.0;
  for (const StationPoint& p : points) {
    const Vector2d way = carry.point(p.point) - eye_;
    const double range = way.norm();
    if (range <= 0.0) continue;
    const double cosine = std::abs(carry.direction(p.normal).dot(way)) / range;
    if (cosine < kLeastCosine) continue;
    if ((open_to(std::atan2(way.y(), way.x())) - range) * cosine > through_m) through += 1.0;
  }
  return through / static_cast<double>(points.size());
}

}  // namespace adit
