#include "adit/io/log_file.hpp"

#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

namespace adit {

/// Keeps every n-th scan of each laser; n doubles whenever there are too many.
class LogFile::Sampler {
 public:
  Sampler(Log& log, std::size_t most_ranges) : log_(log), most_ranges_(most_ranges) {}

  void add(LogScan&& scan) {
    ++scans_;
    if (next_of(seen_, scan.scan.scanner) % stride_ != 0) return;
    ranges_ += scan.scan.ranges.size();
    log_.scans.push_back(std::move(scan));
    if (ranges_ > most_ranges_) halve();
  }
  std::size_t scans() const { return scans_; }

 private:
  /// The number of the laser's next scan, from 0.
  static std::size_t next_of(std::vector<std::size_t>& counts, int laser) {
    const auto number = static_cast<std::size_t>(laser);
    if (counts.size() <= number) counts.resize(number + 1, 0);
    return counts[number]++;
  }

  /// Leaves every second scan of each laser, the first among them.
  void halve() {
    std::vector<std::size_t> held;
    ranges_ = 0;
    std::erase_if(log_.scans, [&](const LogScan& scan) {
      if (next_of(held, scan.scan.scanner) % 2 != 0) return true;
      ranges_ += scan.scan.ranges.size();
      return false;
    });
    stride_ *= 2;
  }

  Log& log_;
  std::size_t most_ranges_;
  std::size_t scans_ = 0;
  std::vector<std::size_t> seen_;  // scans, of each laser
  std::size_t ranges_ = 0;
  std::size_t stride_ = 1;
};

Result<LogFile> LogFile::open(const std::string& path, const LogOptions& options,
                              std::size_t most_ranges) {
  std::error_code ignored;
  const bool again = std::filesystem::is_regular_file(path, ignored);
  LogFile log(path, options);
  Sampler sampler(log.sample_, again ? most_ranges : std::numeric_limits<std::size_t>::max());
  const auto read = stream_log(path, log.reader_, [&](LogMessage&& message) {
    if (auto* scan = std::get_if<LogScan>(&message)) {
      scan->odometry_before = log.sample_.odometry.size();
      sampler.add(std::move(*scan));
    } else {
      log.sample_.add(std::move(message));
    }
  });
  if (!read) return tl::unexpected(read.error());
  log.scans_ = sampler.scans();
  log.sample_.summary = log.reader_.summary();
  MaxRangeSettler settler(log.reader_);
  for (LogScan& scan : log.sample_.scans) settler.settle(scan);
  return log;
}

Result<void> LogFile::visit_scans(const std::function<void(const LogScan&)>& take) const {
  if (sample_.scans.size() == scans_) {
    for (const LogScan& scan : sample_.scans) take(scan);
    return {};
  }
  CarmenReader reader(options_.max_range_m);
  MaxRangeSettler settler(reader_);
  std::size_t scans = 0;
  std::size_t odometry = 0;
  auto read = stream_log(path_, reader, [&](LogMessage&& message) {
    if (std::get_if<LogOdometry>(&message) != nullptr) ++odometry;
    auto* scan = std::get_if<LogScan>(&message);
    if (scan == nullptr || ++scans > scans_) return;
    scan->odometry_before = odometry;
    settler.settle(*scan);
    take(*scan);
  });
  if (!read) return read;
  if (scans != scans_) return fail("the log has changed since it was read first", path_);
  return {};
}

}  // namespace adit
