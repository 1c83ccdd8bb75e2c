#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "adit/io/warning.hpp"
#include "adit/motion/odometry.hpp"
#include "adit/scan/laser_scan.hpp"

namespace adit {

/// Which kind of CARMEN message carries the scans of a laser.
enum class LaserKind { flaser, rlaser, robotlaser };

/// One laser of the machine: the kind of its messages and, for ROBOTLASERn, its n.
struct LaserId {
  LaserKind kind = LaserKind::robotlaser;
  int number = 1;

  bool operator==(const LaserId&) const = default;
};

/// "FLASER", "RLASER", "ROBOTLASER1".
std::string to_string(const LaserId& laser);

/// A scan of a log, where the odometry saw the vehicle then, and where it stands in the file.
struct LogScan {
  LaserScan scan;
  Pose2 odom_from_vehicle;
  LaserId laser;
  double accuracy_m = 0.0;  ///< the log's own field; 0 when it has none
  long line = 0;            ///< in the file, from 1; 0 for scans that come from no file
  /// How many of the log's ODOM messages stand before it: a log is in the order of arrival, which
  /// need not be that of the stamps.
  std::size_t odometry_before = 0;
};

/// An ODOM message: odom_from_vehicle.
struct LogOdometry {
  StampedPose odom_from_vehicle;
};

/// A TRUEPOS message: where a simulator says that the vehicle is. Not for estimators.
struct LogTruePose {
  StampedPose map_from_vehicle;
};

/// What one line of a log says; monostate for a line that says nothing of these.
using LogMessage = std::variant<std::monostate, LogScan, LogOdometry, LogTruePose>;

/// Where the range at which a scan has no return comes from.
enum class RangeSource {
  configuration,  ///< given by the caller
  parameter,      ///< a PARAM line of the log
  field,          ///< the maximum_range of the scan's own line
  found,          ///< the value at the top of the ranges that many beams share
  assumed,        ///< nothing says: above every range of the log
};

/// "configuration", "parameter", "field", "found", "assumed".
const char* to_string(RangeSource source);

/// What a log's scans of one laser have in common.
struct LaserSummary {
  LaserId laser;
  long scans = 0;
  std::size_t fewest_beams = 0;
  std::size_t most_beams = 0;
  double max_range = 0.0;  ///< m; of the last scan, where it changes
  RangeSource max_range_source = RangeSource::assumed;
  double accuracy_m = 0.0;  ///< as the last scan's line says; 0: it does not say
};

/// What the reading of a log met.
struct LogSummary {
  long lines = 0;
  std::vector<LaserSummary> lasers;           ///< in the order in which they appear
  std::map<std::string, std::string> params;  ///< name and value of the PARAM lines
  std::map<std::string, long> ignored;        ///< messages that are not read, and how many
  std::vector<Warning> warnings;

  long scans() const;
};

/// A whole log: messages of each kind in the order of the file. Scans number their scanner by the
/// place of their laser in the summary.
struct Log {
  std::vector<LogScan> scans;
  std::vector<StampedPose> odometry;    ///< odom_from_vehicle of the ODOM messages
  std::vector<StampedPose> true_poses;  ///< map_from_vehicle of the TRUEPOS messages
  LogSummary summary;

  /// Puts a message where it belongs.
  void add(LogMessage&& message);
};

}  // namespace adit
