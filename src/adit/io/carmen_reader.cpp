#include <algorithm>
#include <cmath>
#include <limits>

#include "adit/io/carmen.hpp"
#include "adit/io/text.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostIgnoredNames = 64;  // a broken file must not fill the memory with names
constexpr std::size_t kMostParams = 4096;
constexpr int kMostLasers = 32;
constexpr double kMostTurn = 1.1 * kTwoPi;  // some scanners repeat their first beams
constexpr const char* kReadings = "as many range readings as num_readings says";
constexpr const char* kRemissions = "as many remissions as num_remissions says";
constexpr double kLargest = 1e9;  // m; squares of more lose the rest

/// n of "ROBOTLASERn"; 0 when the name is another one.
int robotlaser_number(std::string_view name) {
  constexpr std::string_view kPrefix = "ROBOTLASER";
  if (name.substr(0, kPrefix.size()) != kPrefix) return 0;
  const auto number = to_number(name.substr(kPrefix.size()));
  if (!number || !(*number >= 1.0) || *number > kMostLasers) return 0;
  return *number == std::floor(*number) ? static_cast<int>(*number) : 0;
}

/// A maximum range that makes sense, or infinity.
double stated_range(double maximum) {
  return maximum > 0.0 && maximum < kLargest ? maximum : kUnknown;
}

}  // namespace

/// The fields of one line; the first one that is missing or wrong is remembered, and what follows
/// it reads as zeros.
struct CarmenReader::LineFields {
  LineFields(std::string_view line, long number) : fields(line), line_number(number) {}

  bool good() const { return expected == nullptr; }

  double number(const char* what) {
    double value = 0.0;
    if (good() && (!fields.next(value) || !std::isfinite(value))) expected = what;
    return good() ? value : 0.0;
  }

  Pose2 pose(const char* what) {
    const double x = number(what);
    const double y = number(what);
    const double theta = number(what);
    if (good() && std::max({std::abs(x), std::abs(y), std::abs(theta)}) > kLargest) expected = what;
    return {x, y, wrap_angle(theta)};
  }

  /// A count of fields to follow; never more than the rest of the line can hold.
  std::size_t count(const char* what, const char* what_follows) {
    const double value = number(what);
    const double most = 0.5 * static_cast<double>(fields.characters_left()) + 1.0;
    if (good() && !(value >= 0.0 && value == std::floor(value))) expected = what;
    if (good() && value > most) expected = what_follows;
    return good() ? static_cast<std::size_t>(value) : 0;
  }

  void skip(std::size_t how_many, const char* what) {
    std::string_view ignored;
    for (std::size_t i = 0; i < how_many && good(); ++i)
      if (!fields.next(ignored)) expected = what;
  }

  /// Readings may be `nan` or `inf`: no return.
  std::vector<double> readings(std::size_t how_many) {
    std::vector<double> ranges(how_many);
    for (double& range : ranges) {
      if (fields.next(range)) continue;
      expected = kReadings;
      break;
    }
    return ranges;
  }

  /// The ipc timestamp; a host must follow, since a line cut within the number would still be one.
  double stamp() {
    const double value = number("ipc_timestamp");
    skip(1, "ipc_hostname");
    return value;
  }

  StampedPose read_odometry() {
    StampedPose out;
    out.pose = pose("x y theta");
    skip(3, "tv rv accel");
    out.stamp = stamp();
    return out;
  }

  StampedPose read_true_pose() {
    StampedPose out;
    out.pose = pose("true_x true_y true_theta");
    pose("odom_x odom_y odom_theta");
    out.stamp = stamp();
    return out;
  }

  Fields fields;
  std::string_view name;
  long line_number = 0;
  const char* expected = nullptr;
};

LogMessage CarmenReader::read_line(std::string_view line) {
  LineFields fields(line, ++summary_.lines);
  if (!fields.fields.next(fields.name) || fields.name.empty() || fields.name.front() == '#')
    return {};
  LogMessage message = read_message(fields);
  if (fields.good()) return message;
  count_warning(summary_.warnings,
                std::string(fields.name) + " line skipped: expected " + fields.expected,
                summary_.lines);
  return {};
}

LogMessage CarmenReader::read_message(LineFields& fields) {
  if (fields.name == "FLASER") return read_flaser(fields, LaserKind::flaser);
  if (fields.name == "RLASER") return read_flaser(fields, LaserKind::rlaser);
  if (fields.name == "ODOM") return LogOdometry{fields.read_odometry()};
  if (fields.name == "TRUEPOS") return LogTruePose{fields.read_true_pose()};
  if (const int number = robotlaser_number(fields.name)) return read_robotlaser(fields, number);
  if (fields.name == "PARAM") {
    read_param(fields);
  } else {
    ignore(fields.name);
  }
  return {};
}

LogMessage CarmenReader::read_flaser(LineFields& fields, LaserKind kind) {
  LogScan out;
  out.laser = {kind, 1};
  const std::size_t beams = fields.count("num_readings", kReadings);
  if (fields.good() && beams < 2) fields.expected = "num_readings of 2 or more";
  if (!fields.good()) return {};
  out.scan.ranges = fields.readings(beams);
  fields.skip(3, "x y theta of the laser");
  out.odom_from_vehicle = fields.pose("odom_x odom_y odom_theta");
  out.scan.stamp = fields.stamp();
  const auto steps = static_cast<double>(beams % 2 == 0 ? beams : beams - 1);
  out.scan.first_bearing = -0.5 * kPi;
  out.scan.bearing_step = kPi / steps;
  const bool rear = kind == LaserKind::rlaser;
  const std::string side = rear ? "rear" : "front";
  out.scan.vehicle_from_laser = {param("robot_" + side + "laser_offset").value_or(0.0),
                                 param("robot_" + side + "laser_side_offset").value_or(0.0),
                                 rear ? kPi : 0.0};
  const auto maximum = param("robot_" + side + "_laser_max");
  out.scan.max_range = stated_range(maximum.value_or(0.0));
  return finish(fields, std::move(out), RangeSource::parameter);
}

LogMessage CarmenReader::read_robotlaser(LineFields& fields, int number) {
  LogScan out;
  out.laser = {LaserKind::robotlaser, number};
  fields.skip(1, "laser_type");
  out.scan.first_bearing = fields.number("start_angle");
  fields.skip(1, "field_of_view");
  out.scan.bearing_step = fields.number("angular_resolution");
  out.scan.max_range = stated_range(fields.number("maximum_range"));
  out.accuracy_m = std::max(0.0, fields.number("accuracy"));
  fields.skip(1, "remission_mode");
  const std::size_t beams = fields.count("num_readings", kReadings);
  if (fields.good() && beams < 1) fields.expected = "num_readings of 1 or more";
  const double turn = std::abs(out.scan.bearing_step) * static_cast<double>(beams);
  if (fields.good() && !(turn > 0.0 && turn < kMostTurn))
    fields.expected = "an angular_resolution in radians that makes at most one turn";
  if (!fields.good()) return {};
  out.scan.ranges = fields.readings(beams);
  fields.skip(fields.count("num_remissions", kRemissions), kRemissions);
  const Pose2 odom_from_laser = fields.pose("laser_pose_x laser_pose_y laser_pose_theta");
  out.odom_from_vehicle = fields.pose("robot_pose_x robot_pose_y robot_pose_theta");
  out.scan.vehicle_from_laser = inverse(out.odom_from_vehicle) * odom_from_laser;
  fields.skip(5, "laser_tv laser_rv forward_safety_dist side_safety_dist turn_axis");
  out.scan.stamp = fields.stamp();
  return finish(fields, std::move(out), RangeSource::field);
}

void CarmenReader::read_param(LineFields& fields) {
  std::string_view name;
  std::string_view value;
  if (!fields.fields.next(name) || !fields.fields.next(value)) {
    fields.expected = "param_name param_value";
  } else if (summary_.params.size() < kMostParams) {
    summary_.params[std::string(name)] = std::string(value);
  }
}

LogMessage CarmenReader::finish(LineFields& fields, LogScan out, RangeSource source) {
  if (!fields.good()) return {};
  if (last_stamp_ && out.scan.stamp < *last_stamp_)
    count_warning(summary_.warnings, "scan stamped earlier than the one before",
                  fields.line_number);
  last_stamp_ = out.scan.stamp;
  if (out.scan.max_range == kUnknown) source = RangeSource::assumed;
  if (max_range_) {
    out.scan.max_range = *max_range_;
    source = RangeSource::configuration;
  }
  out.line = fields.line_number;

  Laser& state = laser(out.laser);
  out.scan.scanner = static_cast<int>(&state - lasers_.data());
  LaserSummary& known = state.summary;
  const std::size_t beams = out.scan.ranges.size();
  known.fewest_beams = known.scans == 0 ? beams : std::min(known.fewest_beams, beams);
  known.most_beams = std::max(known.most_beams, beams);
  known.max_range = out.scan.max_range;
  known.max_range_source = source;
  known.accuracy_m = out.accuracy_m;
  ++known.scans;
  state.finder.add(out.scan.ranges);
  return out;
}

std::optional<double> CarmenReader::param(const std::string& name) const {
  const auto found = summary_.params.find(name);
  if (found == summary_.params.end()) return std::nullopt;
  const auto value = to_number(found->second);
  return value && std::abs(*value) < kLargest ? value : std::nullopt;
}

void CarmenReader::ignore(std::string_view name) {
  std::string key = in_quotes(name);
  key = key.substr(1, key.size() - 2);
  if (summary_.ignored.size() >= kMostIgnoredNames && !summary_.ignored.contains(key))
    key = "other";
  ++summary_.ignored[key];
}

CarmenReader::Laser& CarmenReader::laser(const LaserId& id) {
  for (Laser& known : lasers_)
    if (known.summary.laser == id) return known;
  Laser added;
  added.summary.laser = id;
  lasers_.push_back(std::move(added));
  return lasers_.back();
}

double CarmenReader::max_range(const LaserId& id, double stated) const {
  if (max_range_) return *max_range_;
  const auto known = std::find_if(lasers_.begin(), lasers_.end(),
                                  [&](const Laser& l) { return l.summary.laser == id; });
  if (known == lasers_.end()) return stated;
  if (stated < kUnknown) return known->finder.find(stated).value_or(stated);
  const double above_all = std::min(1.01 * known->finder.largest(), MaxRangeFinder::kFarthest);
  return known->finder.find().value_or(std::max(ScannerModel{}.max_range_m, above_all));
}

LogSummary CarmenReader::summary() const {
  LogSummary out = summary_;
  for (const Laser& known : lasers_) {
    LaserSummary laser = known.summary;
    const double stated = laser.max_range;
    laser.max_range = max_range(laser.laser, stated);
    const bool shown = known.finder.find().has_value();
    if (laser.max_range_source == RangeSource::assumed ? shown : laser.max_range < stated)
      laser.max_range_source = RangeSource::found;
    out.lasers.push_back(laser);
  }
  return out;
}

void MaxRangeSettler::settle(LogScan& scan) {
  auto known = std::find_if(last_.begin(), last_.end(),
                            [&](const Settled& s) { return s.laser == scan.laser; });
  if (known == last_.end()) {
    last_.push_back({scan.laser, std::nan(""), 0.0});
    known = last_.end() - 1;
  }
  if (known->stated != scan.scan.max_range) {
    known->stated = scan.scan.max_range;
    known->settled = reader_.max_range(scan.laser, known->stated);
  }
  scan.scan.max_range = known->settled;
}

}  // namespace adit
