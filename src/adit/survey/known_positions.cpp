#include "adit/survey/known_positions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "adit/map/line_map.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {
namespace {

constexpr double kTurnStep = radians(1.0);
constexpr double kFineTurn = radians(0.1);
constexpr double kFitReach = 0.5;   // m: hits farther from a wall are not fitted to it
constexpr double kFitScale = 0.15;  // m: where a hit's pull is halved; the walls' own roughness
constexpr int kFitSteps = 3;
constexpr double kSettled = radians(0.02);  // stations that turn less, root mean square, stay
constexpr double kClearlyBetter = 0.02;     // of the beams: else a scan's heading stays
constexpr double kSteep = radians(75.0);
constexpr double kMostTilt = 3.0;  // sigmas
constexpr double kLikeWall = 0.6;  // cosine between a hit's normal and its wall's

/// Headings are told by walls that are met steeply; flat hits lie as their wall's bumps do.
WallOptions steep(WallOptions walls) {
  walls.max_incidence_rad = std::min(walls.max_incidence_rad, kSteep);
  return walls;
}

/// Beams that end nearer than this met no roof or floor: no tilt is so large (m).
double sure_range(const TiltOptions& tilt) {
  if (tilt.tilt_sigma_rad <= 0.0) return std::numeric_limits<double>::max();
  double height = std::numeric_limits<double>::max();
  if (tilt.roof_above_m > 0.0) height = std::min(height, tilt.roof_above_m);
  if (tilt.floor_below_m > 0.0) height = std::min(height, tilt.floor_below_m);
  return height / std::sin(kMostTilt * tilt.tilt_sigma_rad);
}

class StationSurvey {
 public:
  StationSurvey(std::span<const PositionedScan> given, const ScannerModel& scanner,
                const KnownPositionsOptions& options, const WallOptions& walls)
      : given_(given),
        scanner_(scanner),
        options_(options),
        walls_(walls),
        finder_(scanner, steep(walls)) {
    walls_.min_scans = options.min_scans;
    walls_.min_hits_per_m = options.min_hits_per_m;
    walls_.gap_m = options.gap_m;
    walls_.sure_range_m = std::min(walls.sure_range_m, sure_range(options.tilt));
  }

  Result<KnownPositionsSurvey> run(const SurveyProgress& progress) {
    const auto report = [&](double share) {
      if (progress) progress(share);
    };
    group_stations();
    align_within_stations();
    const auto seen = std::count_if(views_.begin(), views_.end(),
                                    [](const StationView& v) { return !v.points.empty(); });
    if (seen < 2) return fail("a survey needs scans with returns from two positions at least");
    report(0.2);
    const std::vector<StationHeading> headings = find_headings(views_, options_.search);
    report(0.5);
    if (take_headings(headings) < 2) {
      return fail("no two positions see the same walls: headings cannot be found");
    }
    for (std::size_t i = 0; i < given_.size(); ++i) {
      const auto station = static_cast<std::size_t>(survey_.scans[i].station);
      const Vector2d& p = given_[i].position;
      survey_.scans[i].map_from_vehicle = {p.x(), p.y(),
                                           wrap_angle(headings[station].heading_rad + turns_[i])};
      keep_near_given(given_[i].heading, survey_.scans[i].map_from_vehicle.theta);
    }
    make_walls();
    report(0.7);
    bool settled = false;
    for (int round = 0; round < options_.rounds && !settled; ++round) {
      settled = improve_against_walls() < kSettled;
      make_walls();
      report(0.7 + 0.3 * (round + 1) / options_.rounds);
    }
    report(1.0);
    return std::move(survey_);
  }

 private:
  void group_stations() {
    for (std::size_t i = 0; i < given_.size(); ++i) {
      auto& stations = survey_.stations;
      const auto same = std::find_if(stations.begin(), stations.end(), [&](const auto& s) {
        return (s.position - given_[i].position).norm() < options_.same_station_m;
      });
      const auto station = static_cast<int>(same - stations.begin());
      if (same == stations.end()) {
        stations.push_back({given_[i].position, {}, 0, true});
        const Vector2d eye = given_[i].scan.vehicle_from_laser.translation();
        views_.push_back(
            {given_[i].position, std::nullopt, {}, StationSight(eye), walls_.sure_range_m});
      }
      ++stations[static_cast<std::size_t>(station)].scans;
      survey_.scans.push_back({i, station, {}, {}});
      level_.push_back(given_[i].scan);
    }
  }

  /// How many stations agree with others.
  int take_headings(const std::vector<StationHeading>& headings) {
    int placed = 0;
    for (std::size_t s = 0; s < headings.size(); ++s) {
      survey_.stations[s].heading = headings[s];
      survey_.stations[s].placed = headings[s].agreement >= options_.least_agreement;
      if (survey_.stations[s].placed) ++placed;
    }
    return placed;
  }

  std::vector<StationPoint> points_of(std::size_t scan) {
    PosedScan posed;
    posed.scan = given_[scan].scan;
    std::vector<StationPoint> points;
    for (const WallHit& hit : finder_.find(posed)) points.push_back({hit.point, hit.normal});
    return thin_points(points, 0.5 * options_.search.point_spacing_m);
  }

  /// Turns of a scan from the first of its station: all, or those that given headings leave.
  std::pair<double, double> turns_to_try(std::size_t first, std::size_t scan) const {
    const double reach = options_.turn_within_station_rad;
    const auto& a = given_[first].heading;
    const auto& b = given_[scan].heading;
    if (!a || !b) return {-reach, reach};
    const double middle = angle_between(*a, *b);
    const double within = std::min(reach, 2.0 * options_.search.given_within_rad);
    return {middle - within, middle + within};
  }

  /// What the headings given for its scans say of a station's, on average.
  std::optional<double> given_heading(std::span<const std::size_t> scans) const {
    const std::optional<double>& first = given_[scans.front()].heading;
    if (!first) return std::nullopt;
    double sum = 0.0;
    double count = 0.0;
    for (const std::size_t scan : scans) {
      if (!given_[scan].heading) continue;
      sum += angle_between(*first, *given_[scan].heading - turns_[scan]);
      count += 1.0;
    }
    return *first + sum / count;
  }

  /// Turns each scan onto the first of its station, and gathers their points.
  void align_within_stations() {
    turns_.assign(given_.size(), 0.0);
    std::vector<std::vector<std::size_t>> scans_of(views_.size());
    for (const SurveyedScan& s : survey_.scans) {
      scans_of[static_cast<std::size_t>(s.station)].push_back(s.scan);
    }
    for (std::size_t station = 0; station < views_.size(); ++station) {
      StationView& view = views_[station];
      view.points = points_of(scans_of[station].front());
      view.sight.add(given_[scans_of[station].front()].scan, 0.0, scanner_);
      StationField field(view.points, options_.search.coarse_blur_m);
      for (std::size_t k = 1; k < scans_of[station].size(); ++k) {
        const std::size_t scan = scans_of[station][k];
        const std::vector<StationPoint> points = points_of(scan);
        const auto [from, to] = turns_to_try(scans_of[station].front(), scan);
        double turn = find_turn(thin_points(points, 2.0 * options_.search.point_spacing_m), field,
                                from, to, kTurnStep);
        turn = find_turn(points, field, turn - kTurnStep, turn + kTurnStep, kFineTurn);
        turns_[scan] = turn;
        view.sight.add(given_[scan].scan, turn, scanner_);
        const RigidTransform carry({0.0, 0.0, turn});
        for (const StationPoint& p : points) {
          view.points.push_back({carry.point(p.point), carry.direction(p.normal)});
        }
      }
      view.points = thin_points(view.points, 0.5 * options_.search.point_spacing_m);
      view.sight.finish();
      view.heading = given_heading(scans_of[station]);
    }
  }

  /// No farther from a heading that is given than it may err.
  void keep_near_given(const std::optional<double>& given, double& theta) const {
    if (!given) return;
    const double within = options_.search.given_within_rad;
    theta = wrap_angle(*given + std::clamp(angle_between(*given, theta), -within, within));
  }

  void make_walls() {
    std::vector<PosedScan>& posed = survey_.levelled;
    posed.clear();
    survey_.visits.clear();
    std::vector<std::size_t> order(given_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    // A station is one visit, whatever the order in which its scans come.
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return survey_.scans[a].station < survey_.scans[b].station;
    });
    for (const std::size_t i : order) {
      const auto station = static_cast<std::size_t>(survey_.scans[i].station);
      if (!survey_.stations[station].placed) continue;
      PosedScan p{level_[i], survey_.scans[i].map_from_vehicle, Matrix3d::Zero()};
      const double sigma = std::min(survey_.stations[station].heading.sigma_rad, radians(1.0));
      p.covariance(2, 2) = sigma * sigma;
      posed.push_back(std::move(p));
      survey_.visits.push_back(survey_.scans[i].station);
    }
    survey_.walls = survey_walls(posed, scanner_, walls_, survey_.visits);
  }

  /// Turns each scan onto the walls of all, then takes out its tilt. By how much the stations
  /// turned (rad, root mean square).
  double improve_against_walls() {
    const std::vector<Segment> segments = survey_.walls.segments();
    const LineMap map = LineMap::build(segments);
    std::vector<double> turns(survey_.stations.size(), 0.0);
    for (std::size_t i = 0; i < given_.size(); ++i) {
      const LaserScan& scan = given_[i].scan;
      SurveyedScan& found = survey_.scans[i];
      const double before = found.map_from_vehicle.theta;
      found.map_from_vehicle.theta = likelier_heading(map, i);
      turn_onto(map, scan, found.map_from_vehicle);
      keep_near_given(given_[i].heading, found.map_from_vehicle.theta);
      const std::vector<double> ranges = ranges_to_walls(map, scan, found.map_from_vehicle);
      found.tilt = estimate_tilt(scan, ranges, options_.tilt);
      level_[i] = level_scan(scan, ranges, found.tilt, options_.tilt, scanner_);
      const auto station = static_cast<std::size_t>(found.station);
      turns[station] += angle_between(before, found.map_from_vehicle.theta) /
                        static_cast<double>(survey_.stations[station].scans);
    }
    return settle_stations(turns);
  }

  /// Gives the stations the headings of their first scans; the turns' root mean square over those
  /// that are in the walls.
  double settle_stations(std::span<const double> turns) {
    for (std::size_t i = survey_.scans.size(); i-- > 0;) {
      const auto& scan = survey_.scans[i];
      survey_.stations[static_cast<std::size_t>(scan.station)].heading.heading_rad =
          scan.map_from_vehicle.theta;
    }
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t s = 0; s < turns.size(); ++s) {
      if (!survey_.stations[s].placed) continue;
      squares += turns[s] * turns[s];
      count += 1.0;
    }
    return std::sqrt(squares / count);
  }

  /// The scan's heading, or the one the other way or its station's where walls speak for that; none
  /// other where one was given.
  double likelier_heading(const LineMap& map, std::size_t scan) {
    const SurveyedScan& found = survey_.scans[scan];
    const auto& station = survey_.stations[static_cast<std::size_t>(found.station)];
    const auto score = [&](double theta) {
      Pose2 pose = found.map_from_vehicle;
      pose.theta = theta;
      return fit_to_walls(map, given_[scan].scan, pose);
    };
    double best = found.map_from_vehicle.theta;
    if (given_[scan].heading) return best;
    double most = score(best) + kClearlyBetter;
    for (const double other : {wrap_angle(best + kPi), station.heading.heading_rad}) {
      const double fits = score(other);
      if (fits <= most) continue;
      most = fits;
      best = other;
    }
    return best;
  }

  /// Share of the beams that end at a wall, less the share of those that went through one. What
  /// ends before is clutter, roof or floor and says nothing.
  double fit_to_walls(const LineMap& map, const LaserScan& scan, const Pose2& map_from_vehicle) {
    const std::vector<double> walls = ranges_to_walls(map, scan, map_from_vehicle);
    double sum = 0.0;
    double beams = 0.0;
    for (std::size_t i = 0; i < walls.size(); ++i) {
      if (!scan.has_return(i)) continue;
      beams += 1.0;
      const double beyond = scan.ranges[i] - walls[i];
      if (beyond > options_.search.through_m) {
        sum -= 1.0;
      } else if (beyond > -options_.search.through_m) {
        sum += 1.0;
      }
    }
    return beams > 0.0 ? sum / beams : 0.0;
  }

  /// Gauss-Newton on the heading alone; hits pull by their distance from the nearest wall.
  void turn_onto(const LineMap& map, const LaserScan& scan, Pose2& pose) {
    for (int step = 0; step < kFitSteps; ++step) {
      PosedScan posed{scan, pose, Matrix3d::Zero()};
      double information = 0.0;
      double pull = 0.0;
      for (const WallHit& hit : finder_.find(posed)) {
        const auto residual = distance_to_wall(map, hit);
        if (!residual) continue;
        const double scaled = *residual / kFitScale;
        // Flat hits err by the wall's roughness as much as by the heading.
        const double cosine = hit.normal.dot((pose.translation() - hit.point).normalized());
        const double weight = cosine * cosine / (1.0 + scaled * scaled);
        const double lever = cross(hit.point - pose.translation(), hit.normal);
        information += weight * lever * lever;
        pull += weight * lever * *residual;
      }
      if (information <= 0.0) return;
      pose.theta = wrap_angle(pose.theta - std::clamp(pull / information, -0.03, 0.03));
    }
  }

  /// Signed, along the hit's normal (m); nothing where no like wall is near.
  std::optional<double> distance_to_wall(const LineMap& map, const WallHit& hit) {
    near_.clear();
    map.near(hit.point, kFitReach, near_);
    std::optional<double> best;
    for (const int w : near_) {
      const Segment& s = map.walls()[static_cast<std::size_t>(w)].segment;
      const Vector2d normal = perpendicular(s.b - s.a).normalized();
      if (std::abs(normal.dot(hit.normal)) < kLikeWall) continue;
      const Vector2d from_wall = hit.point - nearest_point(s, hit.point);
      const double d = from_wall.norm();
      if (!best || d < std::abs(*best)) best = from_wall.dot(hit.normal) < 0.0 ? -d : d;
    }
    return best;
  }

  /// Level distance to the wall in the way of each beam (m), infinite for none.
  std::vector<double> ranges_to_walls(const LineMap& map, const LaserScan& scan,
                                      const Pose2& map_from_vehicle) {
    const Pose2 laser = map_from_vehicle * scan.vehicle_from_laser;
    visibility_.sweep(map, laser.translation(), scanner_.no_return_from(scan.max_range));
    std::vector<double> ranges(scan.ranges.size());
    if (scan.bearings.empty()) {
      visibility_.ranges(laser.theta + scan.first_bearing, scan.bearing_step, ranges);
      return ranges;
    }
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      visibility_.ranges(laser.theta + scan.bearing(i), 1.0, {&ranges[i], 1});
    }
    return ranges;
  }

  std::span<const PositionedScan> given_;
  const ScannerModel& scanner_;
  const KnownPositionsOptions& options_;
  WallOptions walls_;
  WallHitFinder finder_;
  Visibility visibility_;
  std::vector<int> near_;
  std::vector<StationView> views_;
  std::vector<double> turns_;  // of each scan from the first of its station
  std::vector<LaserScan> level_;
  KnownPositionsSurvey survey_;
};

}  // namespace

Result<KnownPositionsSurvey> survey_known_positions(std::span<const PositionedScan> scans,
                                                    const ScannerModel& scanner,
                                                    const KnownPositionsOptions& options,
                                                    const WallOptions& walls,
                                                    const SurveyProgress& progress) {
  return StationSurvey(scans, scanner, options, walls).run(progress);
}

}  // namespace adit
