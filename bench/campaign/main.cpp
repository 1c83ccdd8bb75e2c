// Trust, measured over one table of cells: docs/campaign.md.
//
//   campaign quick | full GROUP... | cell NAME... | table [NAME...] | list

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <thread>

#include "runner.hpp"
#include "table.hpp"

namespace adit {
namespace {

constexpr const char* kUsage =
    "usage: campaign quick | full GROUP... | cell NAME... | table [NAME...] | list\n"
    "  --drives N      so many drives of each cell, not the table's number\n"
    "  --seed S        of the campaign (default 1)\n"
    "  --threads T     default: all cores\n"
    "  --data DIR      plans of real mines (default: ADIT_DATA, else ../shared/data)\n"
    "  --results DIR   files of the cells, to resume from and to print; `quick` keeps none if it "
    "is\n"
    "                  not given\n"
    "  --fresh         runs drives again that stand in the files\n";

struct Command {
  std::string verb;
  std::vector<std::string> names;
  std::optional<int> drives;
  std::optional<std::string> results;
  RunOptions run;
};

template <class Number>
bool read(std::string_view text, Number& number) {
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  return parsed.ec == std::errc{} && parsed.ptr == end;
}

bool read_option(std::string_view name, std::string_view text, Command& command) {
  if (name == "--seed") return read(text, command.run.seed);
  if (name == "--threads") return read(text, command.run.threads) && command.run.threads > 0;
  if (name == "--drives") return read(text, command.drives.emplace()) && *command.drives > 0;
  if (name == "--data") {
    command.run.data = text;
    return true;
  }
  if (name == "--results") {
    command.results = text;
    return true;
  }
  return false;
}

std::optional<Command> parse(std::span<char* const> words) {
  Command command;
  const char* data = std::getenv("ADIT_DATA");
  command.run.data = data != nullptr ? data : "../shared/data";
  command.run.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string_view word = words[i];
    if (word == "--fresh") {
      command.run.is_fresh = true;
    } else if (word.starts_with("--")) {
      if (++i == words.size() || !read_option(word, words[i], command)) return std::nullopt;
    } else if (command.verb.empty()) {
      command.verb = word;
    } else {
      command.names.emplace_back(word);
    }
  }
  const bool keeps = command.verb != "quick";
  command.run.results = command.results.value_or(keeps ? ADIT_CAMPAIGN_RESULTS : "");
  return command;
}

/// The cells that the command names, and how many drives of each.
std::vector<CellRun> chosen(const Command& command) {
  std::vector<CellRun> runs;
  const auto is_named = [&](std::string_view name) {
    return std::find(command.names.begin(), command.names.end(), name) != command.names.end();
  };
  for (const Cell& cell : all_cells()) {
    const bool is_quick = command.verb == "quick";
    const bool is_in = is_quick                 ? cell.quick > 0
                       : command.verb == "full" ? is_named(cell.group)
                       : command.verb == "cell"
                           ? is_named(cell.name)
                           : command.names.empty() || is_named(cell.name) || is_named(cell.group);
    if (is_in) runs.push_back({&cell, command.drives.value_or(is_quick ? cell.quick : cell.full)});
  }
  return runs;
}

void list() {
  for (const Cell& cell : all_cells()) {
    fmt::print("{:<12} {:<34} {:>4} {:>4}\n", cell.group, cell.name, cell.quick, cell.full);
  }
}

/// The files of the cells, as they stand.
std::vector<CellResults> files_of(std::span<const CellRun> runs, const std::string& folder) {
  std::vector<CellResults> results;
  for (const CellRun& run : runs) {
    if (auto read = read_results(folder, run.cell->name)) results.push_back(std::move(*read));
  }
  return results;
}

int campaign(const Command& command) {
  if (command.verb == "list") {
    list();
    return 0;
  }
  const std::vector<CellRun> runs = chosen(command);
  if (runs.empty()) {
    fmt::print(stderr, "campaign: no such cell or group; `campaign list` names them\n");
    return 2;
  }
  const bool is_run = command.verb != "table";
  fmt::print("{}", table_text(is_run ? run_cells(runs, command.run)
                                     : files_of(runs, command.run.results)));
  return 0;
}

bool is_verb(const std::string& word) {
  return word == "quick" || word == "full" || word == "cell" || word == "table" || word == "list";
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  const auto command = adit::parse({argv + 1, static_cast<std::size_t>(std::max(0, argc - 1))});
  if (!command || !adit::is_verb(command->verb)) {
    fmt::print(stderr, "{}", adit::kUsage);
    return 2;
  }
  return adit::campaign(*command);
}
