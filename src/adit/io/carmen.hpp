#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adit/geometry/result.hpp"
#include "adit/io/log.hpp"
#include "adit/io/max_range.hpp"

namespace adit {

/// Reads a CARMEN log line by line and keeps count of what it met; holds no scans.
///
/// Lasers are numbered in the order in which they appear: the `scanner` of their scans.
/// The time of a message is its first (ipc) timestamp. FLASER and RLASER: the first beam at -90
/// degrees, the step 180/n degrees for even n and 180/(n-1) for odd n; RLASER looks backwards; both
/// sit on the vehicle's axis at the offsets that PARAM lines give; the second pose is the odometry.
/// ROBOTLASERn: beam i at start + i * resolution; the laser's pose against the robot's is the
/// mounting, the robot's pose the odometry. A line that cannot be used is skipped with a warning.
class CarmenReader {
 public:
  /// `max_range` overrides what the log says (m).
  explicit CarmenReader(std::optional<double> max_range = std::nullopt) : max_range_(max_range) {}

  /// What the next line (without its end) says. A scan whose maximum range neither the caller nor
  /// the log states has an infinite one until the whole log is known.
  LogMessage read_line(std::string_view line);

  /// What was met so far, with each laser's maximum range as the lines so far show it.
  LogSummary summary() const;

  /// The maximum range of a laser (m) whose scan states `stated`, which is infinite for one that
  /// does not: a code for "no return" just below it counts, and without it the code alone.
  double max_range(const LaserId& id, double stated) const;

 private:
  struct Laser {
    LaserSummary summary;
    MaxRangeFinder finder;
  };
  struct LineFields;

  LogMessage read_message(LineFields& fields);
  LogMessage read_flaser(LineFields& fields, LaserKind kind);
  LogMessage read_robotlaser(LineFields& fields, int number);
  void read_param(LineFields& fields);
  LogMessage finish(LineFields& fields, LogScan out, RangeSource source);
  std::optional<double> param(const std::string& name) const;
  void ignore(std::string_view name);
  Laser& laser(const LaserId& id);

  std::optional<double> max_range_;
  LogSummary summary_;
  std::vector<Laser> lasers_;
  std::optional<double> last_stamp_;
};

/// Gives scans the maximum range of their laser, once the reader knows the whole log.
class MaxRangeSettler {
 public:
  /// The reader must outlive it.
  explicit MaxRangeSettler(const CarmenReader& reader) : reader_(reader) {}

  void settle(LogScan& scan);

 private:
  /// Of one laser: what a log states hardly ever changes.
  struct Settled {
    LaserId laser;
    double stated = 0.0;
    double settled = 0.0;
  };

  const CarmenReader& reader_;
  std::vector<Settled> last_;
};

/// What the caller knows better than the log.
struct LogOptions {
  std::optional<double> max_range_m;
};

/// The largest step (m, down to 0.1 mm) that all sampled ranges of a laser are multiples of: how
/// the scanner rounds. 0 when none of these steps fits: the ranges are not rounded. Absent when the
/// log holds too few ranges to tell.
std::optional<double> find_range_step(const Log& log, const LaserId& laser);

/// Hands each scan, odometry and true pose of a CARMEN log to `sink` in the file's order; memory
/// does not grow with the file. What the reader met is known afterwards. Errors: the file cannot be
/// read, is binary, or holds no usable scan.
Result<void> stream_log(const std::string& path, CarmenReader& reader,
                        const std::function<void(LogMessage&&)>& sink);

/// Reads a whole CARMEN log; every scan has a finite maximum range. Errors as `stream_log`.
Result<Log> read_log(const std::string& path, const LogOptions& options = {});

/// The same from text; `file` is the name in errors.
Result<Log> parse_log(std::string_view text, const LogOptions& options = {},
                      const std::string& file = {});

/// Writes a log with ROBOTLASERn lines (ROBOTLASER1 for FLASER, ROBOTLASER2 for RLASER), and ODOM
/// and TRUEPOS lines where given, merged by stamp; each kind keeps its order. Reading it back gives
/// the same values; a range that is not finite becomes the maximum range, which means the same.
Result<void> write_carmen(const Log& log, const std::string& path);

/// The text that `write_carmen` writes.
std::string format_carmen(const Log& log);

}  // namespace adit
