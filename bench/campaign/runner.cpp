#include "runner.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <set>

#include "adit/threads/share_out.hpp"
#include "drive_run.hpp"
#include "fingerprint.hpp"
#include "one_scan.hpp"

namespace adit {
namespace {

struct Job {
  std::size_t cell = 0;  // of the runs
  std::int64_t drive = 0;
};

bool is_single(const Cell& cell) { return cell.task == Task::locate || cell.task == Task::outside; }

Result<DriveCounts> run_job(const Cell& cell, Grounds& grounds, std::uint64_t seed,
                            std::int64_t drive) {
  if (is_single(cell)) return run_single_scans(cell, grounds, seed, drive);
  const auto scene = make_scene(cell, grounds, seed, drive);
  if (!scene) return tl::unexpected(scene.error());
  return run_drive(*scene, drive);
}

/// What stands in the cell's file and belongs to this run; a line says what does not.
CellResults resumed(const Cell& cell, const RunOptions& options) {
  CellResults results;
  results.header = {std::string(cell.name), options.seed, fingerprint_of(cell, settings_of(cell)),
                    kDefinitionsVersion};
  if (options.results.empty() || options.is_fresh) return results;
  if (!std::filesystem::exists(results_path(options.results, cell.name))) return results;
  const auto read = read_results(options.results, cell.name);
  if (!read) {
    fmt::print(stderr, "{}: run anew: {}\n", cell.name, to_string(read.error()));
  } else if (!(read->header == results.header)) {
    fmt::print(stderr, "{}: run anew: its rows are of another seed, settings or definitions\n",
               cell.name);
  } else {
    results.drives = read->drives;
  }
  return results;
}

/// Takes the rows from all threads.
class Book {
 public:
  Book(std::span<const CellRun> runs, const RunOptions& options) : runs_(runs), options_(options) {
    for (const CellRun& run : runs) results_.push_back(resumed(*run.cell, options));
  }

  std::vector<Job> missing() const {
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      std::set<std::int64_t> known;
      for (const DriveCounts& counts : results_[i].drives) known.insert(counts.drive);
      for (std::int64_t drive = 0; drive < runs_[i].drives; ++drive) {
        if (!known.contains(drive)) jobs.push_back({i, drive});
      }
    }
    return jobs;
  }

  bool is_left_out(std::size_t cell) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return left_out_.contains(cell);
  }

  void leave_out(const Job& job, const std::string& why) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++done_;
    fmt::print(stderr, "{} {}: left out: {}\n", runs_[job.cell].cell->name, job.drive, why);
  }

  void leave_out_cell(const Job& job) {
    const std::lock_guard<std::mutex> lock(mutex_);
    left_out_.insert(job.cell);
  }

  void add(const Job& job, DriveCounts counts, double seconds, std::size_t jobs) {
    const std::lock_guard<std::mutex> lock(mutex_);
    CellResults& results = results_[job.cell];
    const auto later = std::upper_bound(
        results.drives.begin(), results.drives.end(), counts.drive,
        [](std::int64_t drive, const DriveCounts& other) { return drive < other.drive; });
    fmt::print(stderr, "{}/{} {} {}: {:.1f} s, ok {} of {}, beyond {}, wrong {}\n", ++done_, jobs,
               results.header.cell, counts.drive, seconds, counts.ok, counts.scans, counts.beyond,
               counts.wrong);
    results.drives.insert(later, std::move(counts));
    if (options_.results.empty()) return;
    if (const auto written = write_results(results, options_.results); !written) {
      fmt::print(stderr, "{}\n", to_string(written.error()));
    }
  }

  std::vector<CellResults> take() { return std::move(results_); }

 private:
  std::span<const CellRun> runs_;
  const RunOptions& options_;
  std::mutex mutex_;
  std::vector<CellResults> results_;
  std::set<std::size_t> left_out_;  // cells whose plan is absent
  std::size_t done_ = 0;
};

}  // namespace

std::vector<CellResults> run_cells(std::span<const CellRun> runs, const RunOptions& options) {
  using Clock = std::chrono::steady_clock;
  if (!options.results.empty()) std::filesystem::create_directories(options.results);
  Grounds grounds(options.data, options.threads);
  Book book(runs, options);
  const std::vector<Job> jobs = book.missing();
  share_out(jobs.size(), options.threads, [&] {
    return [&](std::size_t i) {
      const Job& job = jobs[i];
      const Cell& cell = *runs[job.cell].cell;
      if (book.is_left_out(job.cell)) return;
      const auto start = Clock::now();
      if (const auto ground = grounds.of(cell.mine, job.drive); !ground) {
        book.leave_out_cell(job);
        return book.leave_out(job, to_string(ground.error()));
      }
      auto counts = run_job(cell, grounds, options.seed, job.drive);
      if (!counts) return book.leave_out(job, to_string(counts.error()));
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      book.add(job, std::move(*counts), seconds, jobs.size());
    };
  });
  return book.take();
}

}  // namespace adit
