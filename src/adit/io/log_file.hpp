#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adit/io/carmen.hpp"

namespace adit {

/// A CARMEN log of any length, whose scans are read anew whenever they are gone through.
///
/// Memory holds a sample of the scans; a short log is kept whole, and so is one that can be read
/// but once, a pipe.
class LogFile {
 public:
  /// How many ranges the sample may hold; one scan of each laser it always holds.
  static constexpr std::size_t kMostRanges = 4'000'000;

  /// Reads the log a first time. Errors as `read_log`.
  static Result<LogFile> open(const std::string& path, const LogOptions& options = {},
                              std::size_t most_ranges = kMostRanges);

  /// Scans of each laser spread evenly over the log, or all of them; all ODOM and TRUEPOS messages;
  /// the summary of the whole log.
  const Log& sample() const { return sample_; }
  std::size_t scans() const { return scans_; }

  /// Hands over each scan in the file's order. An Error where the log cannot be read any more or
  /// has another number of scans than the first time.
  Result<void> visit_scans(const std::function<void(const LogScan&)>& take) const;

 private:
  class Sampler;

  LogFile(std::string path, const LogOptions& options)
      : path_(std::move(path)), options_(options), reader_(options.max_range_m) {}

  std::string path_;
  LogOptions options_;
  CarmenReader reader_;
  Log sample_;
  std::size_t scans_ = 0;
};

}  // namespace adit
