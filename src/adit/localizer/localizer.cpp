#include "adit/localizer/localizer.hpp"

#include <cmath>
#include <utility>

namespace adit {
namespace {

constexpr std::size_t kWorstWalls = 3;  // of which one may be drawn wrong

bool is_usable(const LaserScan& scan) {
  return std::isfinite(scan.stamp) && scan.vehicle_from_laser.is_finite();
}

}  // namespace

/// The paper's cycle, Fig. 1, with what it names as work to come: all points, and tracking.
const Estimate& Localizer::turn(const LaserScan& scan,
                                const std::optional<Pose2>& odom_from_vehicle) {
  begin_turn();
  LapTimer lap;
  const Motion motion = reckoner_.since_last(scan.stamp, odom_from_vehicle);
  belief_.move(motion);
  lap.add_to(timings_.tracking);
  const Sweep sweep = undoer_.undo(scan, reckoner_.odometry());
  lap.add_to(timings_.deskew);
  fits_ = fitter_.fit(sweep, belief_.expectation(estimate_), timings_);
  lap.skip();  // the fitter times its stages itself
  if (belief_.weigh_rival(fits_)) fits_.best = fitter_.fit_from(sweep, belief_.predicted());
  lap.add_to(timings_.refinement);
  belief_.admit_found();
  if (belief_.is_divided()) hold_against_all(sweep, motion);
  lap.add_to(timings_.search);
  if (belief_.take_in(fits_, motion)) fitter_.learn(sweep, belief_.pose().covariance);
  belief_.seek(fitter_.input(sweep), fits_, motion);
  judge_.drive(motion.has_wheels ? motion.way_m() : moved_since(estimate_.pose));
  estimate_ = judge_.judge(scan.stamp, belief_.believed(), fits_, fitter_.details(sweep));
  lap.add_to(timings_.tracking);
  return estimate_;
}

/// Several poses of the mine may be the true one. Where another is followed from now on, the scan
/// is fitted there.
void Localizer::hold_against_all(const Sweep& sweep, const Motion& motion) {
  const RefinementInput input = fitter_.input(sweep);
  if (!belief_.weigh(input, fits_, fitter_.worst_walls(kWorstWalls), motion)) return;
  judge_.forget();
  fits_ = Fits{};  // features were matched elsewhere
  fits_.best = fitter_.fit_from(sweep, belief_.predicted());
}

double Localizer::moved_since(const Pose2& map_from_vehicle) const {
  return (belief_.pose().pose.translation() - map_from_vehicle.translation()).norm();
}

/// Forgets what the last turn found.
void Localizer::begin_turn() {
  timings_ = Timings{};
  belief_.begin_turn();
}

/// Answers a scan that cannot be used from what is believed already.
const Estimate& Localizer::skip(double stamp) {
  begin_turn();
  fits_ = Fits{};
  fitter_.clear_features();
  estimate_ = judge_.without_scan(stamp, belief_.believed());
  return estimate_;
}

const Estimate& Localizer::update(const LaserScan& scan, const Pose2& odom_from_vehicle) {
  if (!odom_from_vehicle.is_finite() || !is_usable(scan)) return skip(scan.stamp);
  if (reckoner_.is_repeated(scan, odom_from_vehicle)) return estimate_;
  reckoner_.add_odometry({scan.stamp, odom_from_vehicle});
  return turn(scan, odom_from_vehicle);
}

const Estimate& Localizer::update(const LaserScan& scan) {
  if (!is_usable(scan)) return skip(scan.stamp);
  const std::optional<Pose2> odometry = reckoner_.odometry_at(scan.stamp);
  return reckoner_.is_repeated(scan, odometry) ? estimate_ : turn(scan, odometry);
}

Localizer::Localizer(const LineMap& map, const LocalizerSettings& settings,
                     std::shared_ptr<const PlaceIndex> places)
    : settings_(settings),
      reckoner_(settings_),
      undoer_(settings_),
      fitter_(map, settings_),
      belief_(map, settings_, std::move(places)),
      judge_(settings_) {
  start(Pose2{});
}

void Localizer::start(const Pose2& map_from_vehicle, const std::optional<Matrix3d>& covariance) {
  if (!map_from_vehicle.is_finite() || (covariance && !covariance->allFinite())) return;
  const double metres = settings_.localizer.start_sigma_m;
  const double radians = settings_.localizer.start_sigma_rad;
  const Vector3d variance(metres * metres, metres * metres, radians * radians);
  const PoseWithCovariance at{map_from_vehicle,
                              covariance.value_or(Matrix3d(variance.asDiagonal()))};
  reckoner_.reset();
  fitter_.reset();
  belief_.start(at);
  judge_.forget();
  estimate_ = Estimate{};
  estimate_.pose = at.pose;
  estimate_.covariance = at.covariance;
}

void Localizer::start_anywhere() {
  start(Pose2{});
  belief_.start_anywhere();
  estimate_.covariance = unknown_covariance();
}

void Localizer::add_odometry(const StampedPose& odom_from_vehicle) {
  reckoner_.add_odometry(odom_from_vehicle);
}

void Localizer::add_gyro(double stamp, double heading) { reckoner_.add_gyro(stamp, heading); }

Turn Localizer::last_turn() const {
  const FeatureFitter& features = fitter_.features();
  return {belief_.predicted(),
          features.model(),
          features.extractor().features(),
          features.match(),
          features.extractor(),
          fits_.best,
          fitter_.walls(),
          fitter_.map_error(),
          belief_.hypotheses(),
          reckoner_.stamp_counts(),
          timings_};
}

}  // namespace adit
