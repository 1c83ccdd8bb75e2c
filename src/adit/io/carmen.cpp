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

Result<Log> finish_log(const CarmenReader& reader, Log log, const std::string& file) {
  log.summary = reader.summary();
  if (const auto checked = check_any_scan(log.summary, file); !checked)
    return tl::unexpected(checked.error());
  MaxRangeSettler settler(reader);
  for (LogScan& scan : log.scans) settler.settle(scan);
  return log;
}

}  // namespace

Result<void> stream_log(const std::string& path, CarmenReader& reader,
                        const std::function<void(LogMessage&&)>& sink) {
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
  return check_any_scan(reader.summary(), path);
}

Result<Log> read_log(const std::string& path, const LogOptions& options) {
  CarmenReader reader(options.max_range_m);
  Log log;
  const auto read =
      stream_log(path, reader, [&](LogMessage&& message) { log.add(std::move(message)); });
  if (!read) return tl::unexpected(read.error());
  return finish_log(reader, std::move(log), path);
}

Result<Log> parse_log(std::string_view text, const LogOptions& options, const std::string& file) {
  if (const auto checked = check_text(text.substr(0, kLookedAt), file); !checked)
    return tl::unexpected(checked.error());
  CarmenReader reader(options.max_range_m);
  Log log;
  Lines lines(text);
  for (std::string_view line; lines.next(line);) log.add(reader.read_line(line));
  return finish_log(reader, std::move(log), file);
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
