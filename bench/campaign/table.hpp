#pragma once

#include <span>
#include <string>

#include "results.hpp"

namespace adit {

/// The sums of a cell's drives, or of several cells'.
struct Pooled {
  std::int64_t drives = 0;
  std::int64_t hit = 0;           ///< drives with an answer beyond or wrong
  std::int64_t wrong_in = 0;      ///< drives with a wrong answer
  std::int64_t beyond_in = 0;     ///< drives with an answer beyond
  std::int64_t long_silence = 0;  ///< drives that are silent for more than 10 m at a stretch
  DriveCounts sum;                ///< its `drive` and `found_m` mean nothing
  std::vector<double> found_m;    ///< of the drives that found their pose, sorted

  void add(const DriveCounts& counts);
  /// Share of all drives that found their pose within so many metres.
  double found_within(double metres) const;
  /// Way until half of all drives had found their pose; infinity where fewer did.
  double median_found() const;
};

Pooled pooled(const CellResults& results);

/// The tables of docs/benchmarks.md, in Markdown: cells that drive, what all of them but those of
/// faulty scanners come to, and cells of single scans.
std::string table_text(std::span<const CellResults> results);

}  // namespace adit
