#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cell.hpp"
#include "results.hpp"

namespace adit {

/// A cell and how many of its drives are wanted.
struct CellRun {
  const Cell* cell = nullptr;
  int drives = 0;
};

/// How a campaign is run.
struct RunOptions {
  std::string data;     ///< folder of the plans of real mines
  std::string results;  ///< folder of the cells' files; empty keeps nothing
  std::uint64_t seed = 1;
  int threads = 1;
  bool is_fresh = false;  ///< runs drives again that stand in the files
};

/// Runs the drives that do not stand in the files yet, each cell's file written after each of its
/// drives; progress and what was left out go to the standard error. The same rows with any number
/// of threads, but for times. Returns the results of all cells that could be run.
std::vector<CellResults> run_cells(std::span<const CellRun> runs, const RunOptions& options);

}  // namespace adit
