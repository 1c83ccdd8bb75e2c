#include "adit/localizer/judge.hpp"

#include <algorithm>

namespace adit {

void Judge::forget() {
  protection_.reset();
  displacement_.reset();
}

/// What the plan errs as a whole around here: bends, walls that are off in full. Scan after scan
/// sees the same error, so it is no noise that the filter may average; it stands beside what the
/// filter believes. All points of a scan see its bends from end to end; features hang on single
/// walls, whose short errors turn the heading as well.
Matrix3d Judge::plan_error() const {
  constexpr double kBend = 16.0;  // m; on so much way a bend turns the plan by its sigma
  const double metres = settings_.map.sigma_m;
  const double radians = metres / (uses_points() ? kBend : settings_.belief.map_stretch_m);
  return Vector3d(metres * metres, metres * metres, radians * radians).asDiagonal();
}

Estimate Judge::without_scan(double stamp, const Believed& believed) const {
  Estimate estimate;
  estimate.stamp = stamp;
  estimate.pose = believed.pose.pose;
  estimate.covariance = believed.covariance;
  const bool is_alone = !believed.is_anywhere && !believed.is_divided;
  if (is_alone) estimate.covariance += plan_error();
  estimate.dead_reckoned = !believed.has_contributed;
  if (believed.is_divided && believed.has_contributed) estimate.status = Status::ambiguous;
  return estimate;
}

Estimate Judge::judge(double stamp, const Believed& believed, const Fits& fits,
                      const FitDetails& details) {
  Estimate estimate = without_scan(stamp, believed);
  if (!believed.is_trusted) return estimate;
  estimate.status = Status::ok;
  estimate.chi_square = details.features.chi_square;
  estimate.degrees_of_freedom = details.features.degrees_of_freedom;
  if (fits.features.is_believable) estimate.pairs = details.pairs;
  if (!uses_points()) return estimate;
  const ScanFit& fit = fits.best;
  estimate.chi_square = fit.chi_square;
  estimate.degrees_of_freedom = static_cast<int>(fit.counts.wall) - 3;
  estimate.open_direction = open_direction(fix_covariance(fit.information), settings_.status);
  if (estimate.open_direction) estimate.status = Status::degraded;
  if (believed.is_ambiguous) {
    estimate.status = Status::ambiguous;
  } else {
    estimate.protection_m = protection_radius(believed, fits, details);
  }
  return estimate;
}

/// Over the hypotheses that one wall is wrong, that a wall stands where returns are parallel to
/// it, and that the rival is right (m).
double Judge::protection_radius(const Believed& believed, const Fits& fits,
                                const FitDetails& details) {
  walls_.clear();
  for (const WallShare& share : details.walls) {
    walls_.push_back({share.wall, share.equations.information, share.equations.score});
  }
  const PoseWithCovariance& at = believed.pose;
  const Matrix3d error = plan_error();
  double level = protection_.update(at, believed.predicted, fits.best.pose, walls_, error,
                                    settings_.protection);
  const auto cover = [&](double apart, const Matrix3d& covariance) {
    level = std::max(level, apart + radius_of(covariance + error, settings_.protection.risk));
  };
  displacement_.see(largest_displacement(details.beams, details.on_wall, details.scanner,
                                         details.map_sigma_m, settings_.displacement));
  const double displaced = displacement_.largest();
  if (displaced > 0.0) cover(displaced, at.covariance);
  if (believed.rival) {
    const PoseWithCovariance& rival = *believed.rival;
    cover((rival.pose.translation() - at.pose.translation()).norm(), rival.covariance);
  }
  return level;
}

}  // namespace adit
