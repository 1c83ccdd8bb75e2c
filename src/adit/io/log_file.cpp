#include "adit/io/log_file.hpp"

#include <filesystem>
#include <limits>
#include <utility>

namespace adit {

/// Keeps every n-th scan; n doubles whenever there are too many.
class LogFile::Sampler {
 public:
  Sampler(Log& log, std::size_t most_ranges) : log_(log), most_ranges_(most_ranges) {}

  void add(LogScan&& scan) {
    if (scans_++ % stride_ != 0) return;
    ranges_ += scan.scan.ranges.size();
    log_.scans.push_back(std::move(scan));
    while (ranges_ > most_ranges_ && log_.scans.size() > 1) halve();
  }
  std::size_t scans() const { return scans_; }

 private:
  void halve() {
    std::size_t kept = 0;
    ranges_ = 0;
    for (std::size_t i = 0; i < log_.scans.size(); i += 2) {
      ranges_ += log_.scans[i].scan.ranges.size();
      if (kept != i) log_.scans[kept] = std::move(log_.scans[i]);
      ++kept;
    }
    log_.scans.resize(kept);
    stride_ *= 2;
  }

  Log& log_;
  std::size_t most_ranges_;
  std::size_t scans_ = 0;
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
  const auto read = stream_log(path_, reader, [&](LogMessage&& message) {
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
