#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "adit/geometry/result.hpp"
#include "counting.hpp"

namespace adit {

/// What the rows of a file have in common; rows of another one are not resumed from.
struct ResultsHeader {
  std::string cell;
  std::uint64_t seed = 1;
  std::string settings;  ///< fingerprint of what the estimator is given and of the cell's line
  int definitions = kDefinitionsVersion;

  bool operator==(const ResultsHeader&) const = default;
};

/// A cell's file: a header, and a row for each drive.
struct CellResults {
  ResultsHeader header;
  std::vector<DriveCounts> drives;  ///< in the order of their numbers
};

/// The text of a file; each row ends with a full stop, by which a row that was cut off is known.
std::string format_results(const CellResults& results);

/// Reads a text back. Rows that were cut off or spoilt are left out; error: there is no header, or
/// its names of columns are others.
Result<CellResults> parse_results(std::string_view text);

/// The file of a cell in a folder.
std::string results_path(const std::string& folder, std::string_view cell);

/// Reads a cell's file. Error: it cannot be read, or is none.
Result<CellResults> read_results(const std::string& folder, std::string_view cell);

/// Writes a cell's file, whole or not at all.
Result<void> write_results(const CellResults& results, const std::string& folder);

}  // namespace adit
