#include "adit/io/carmen.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <numeric>

#include "adit/io/text.hpp"

namespace adit {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;
constexpr std::size_t kLongestLine = std::size_t{64} << 20;
constexpr std::size_t kLookedAt = 4096;  // for binary data; logs cut by a crash may end in NULs

/// Lines of a file of any length, read block by block.
class FileLines {
 public:
  explicit FileLines(std::FILE* file) : file_(file) {}

  bool next(std::string_view& line) {
    while (true) {
      const char* begin = buffer_.data() + at_;
      if (const void* end = std::memchr(begin, '\n', buffer_.size() - at_)) {
        line = {begin, static_cast<std::size_t>(static_cast<const char*>(end) - begin)};
        at_ += line.size() + 1;
        return true;
      }
      if (buffer_.size() - at_ > kLongestLine) error_ = "a line is longer than 64 MiB";
      if (error_ != nullptr) return false;
      if (!fill()) break;
    }
    line = std::string_view(buffer_).substr(at_);
    at_ = buffer_.size();
    return error_ == nullptr && !line.empty();
  }

  const char* error() const { return error_; }

 private:
  bool fill() {
    buffer_.erase(0, at_);
    at_ = 0;
    const std::size_t kept = buffer_.size();
    buffer_.resize(kept + kBlock);
    const std::size_t got = std::fread(buffer_.data() + kept, 1, kBlock, file_);
    buffer_.resize(kept + got);
    if (std::ferror(file_) != 0) error_ = "cannot read";
    if (first_) {
      const std::string_view head = std::string_view(buffer_).substr(0, kLookedAt);
      if (head.find('\0') != head.npos) error_ = "expected a CARMEN log, found binary data";
      if (head.empty() && error_ == nullptr) error_ = "the file is empty";
      if (head.substr(0, 3) == "\xef\xbb\xbf") at_ = 3;
      first_ = false;
    }
    return got > 0 && error_ == nullptr;
  }

  std::FILE* file_;
  std::string buffer_;
  std::size_t at_ = 0;
  bool first_ = true;
  const char* error_ = nullptr;
};

Result<void> check_any_scan(const LogSummary& summary, const std::string& file) {
  if (summary.scans() > 0) return {};
  std::string message = "no usable laser scan; expected FLASER, RLASER or ROBOTLASER1 lines";
  if (summary.warnings.empty()) return fail(message, file);
  const Warning& first = summary.warnings.front();
  return fail(message + "; " + first.message, file, first.first_line);
}

/// Puts the messages into a log.
struct Collector {
  void operator()(LogMessage&& message) {
    if (auto* scan = std::get_if<LogScan>(&message)) {
      scan->odometry_before = log.odometry.size();
      log.scans.push_back(std::move(*scan));
    } else if (const auto* odometry = std::get_if<LogOdometry>(&message)) {
      log.odometry.push_back(odometry->odom_from_vehicle);
    } else if (const auto* truth = std::get_if<LogTruePose>(&message)) {
      log.true_poses.push_back(truth->map_from_vehicle);
    }
  }
  Log log;
};

/// Now that every range is known, gives each scan its maximum range.
void settle_max_ranges(const CarmenReader& reader, std::vector<LogScan>& scans) {
  struct Settled {
    LaserId laser;
    double stated = 0.0;
    double settled = 0.0;
  };
  std::vector<Settled> last;  // one a laser: what a log states hardly ever changes
  for (LogScan& scan : scans) {
    auto known = std::find_if(last.begin(), last.end(),
                              [&](const Settled& s) { return s.laser == scan.laser; });
    if (known == last.end()) {
      last.push_back({scan.laser, std::nan(""), 0.0});
      known = last.end() - 1;
    }
    if (known->stated != scan.scan.max_range) {
      known->stated = scan.scan.max_range;
      known->settled = reader.max_range(scan.laser, known->stated);
    }
    scan.scan.max_range = known->settled;
  }
}

Result<Log> finish_log(const CarmenReader& reader, Log log, const std::string& file) {
  log.summary = reader.summary();
  if (const auto checked = check_any_scan(log.summary, file); !checked)
    return tl::unexpected(checked.error());
  settle_max_ranges(reader, log.scans);
  return log;
}

template <class Sink>
Result<void> read_lines(const std::string& path, CarmenReader& reader, Sink&& sink) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return fail("expected a file, not a directory", path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) return fail(std::string("cannot open: ") + std::strerror(errno), path);
  FileLines lines(file.get());
  long number = 0;
  for (std::string_view line; lines.next(line); ++number) {
    LogMessage message = reader.read_line(line);
    if (message.index() != 0) sink(std::move(message));
  }
  if (lines.error() != nullptr) return fail(lines.error(), path, number + 1);
  return {};
}

}  // namespace

Result<LogSummary> stream_log(const std::string& path, const LogOptions& options,
                              const std::function<void(LogMessage&&)>& sink) {
  CarmenReader reader(options.max_range_m);
  if (const auto read = read_lines(path, reader, sink); !read) return tl::unexpected(read.error());
  LogSummary summary = reader.summary();
  if (const auto checked = check_any_scan(summary, path); !checked)
    return tl::unexpected(checked.error());
  return summary;
}

Result<Log> read_log(const std::string& path, const LogOptions& options) {
  CarmenReader reader(options.max_range_m);
  Collector collector;
  if (const auto read = read_lines(path, reader, collector); !read)
    return tl::unexpected(read.error());
  return finish_log(reader, std::move(collector.log), path);
}

Result<Log> parse_log(std::string_view text, const LogOptions& options, const std::string& file) {
  if (const auto checked = check_text(text.substr(0, kLookedAt), file); !checked)
    return tl::unexpected(checked.error());
  CarmenReader reader(options.max_range_m);
  Collector collector;
  Lines lines(text);
  for (std::string_view line; lines.next(line);) collector(reader.read_line(line));
  return finish_log(reader, std::move(collector.log), file);
}

std::optional<double> find_range_step(const Log& log, const LaserId& laser) {
  constexpr double kUnitsPerMetre = 1e4;
  constexpr int kEnough = 20000;
  constexpr int kFewest = 50;
  std::int64_t divisor = 0;
  int sampled = 0;
  bool rounded = true;
  for (const LogScan& entry : log.scans) {
    if (!(entry.laser == laser)) continue;
    for (std::size_t i = 0; i < entry.scan.ranges.size() && sampled < kEnough; ++i) {
      if (!entry.scan.has_return(i) || entry.scan.ranges[i] > 1e6) continue;
      const double units = entry.scan.ranges[i] * kUnitsPerMetre;
      if (std::abs(units - std::round(units)) > 1e-4) rounded = false;
      divisor = std::gcd(divisor, std::llround(units));
      ++sampled;
    }
  }
  if (sampled < kFewest) return std::nullopt;
  return rounded ? static_cast<double>(divisor) / kUnitsPerMetre : 0.0;
}

}  // namespace adit
