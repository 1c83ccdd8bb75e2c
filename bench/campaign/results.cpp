#include "results.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <type_traits>

#include "adit/io/atomic_file.hpp"

namespace adit {
namespace {

constexpr std::string_view kRowEnd = ".";

std::string value_text(std::int64_t value) { return fmt::format("{}", value); }
std::string value_text(double value) { return fmt::format("{:.6g}", value); }
std::string value_text(const Histogram& value) { return value.text(); }

template <class Number>
bool read_value(std::string_view text, Number& value) {
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  return parsed.ec == std::errc{} && parsed.ptr == end;
}

bool read_value(std::string_view text, Histogram& value) {
  const auto histogram = Histogram::parse(text);
  if (histogram) value = *histogram;
  return histogram.has_value();
}

std::string names_line() {
  std::string line = "#";
  DriveCounts counts;
  DriveCounts::visit(counts, [&](const char* name, auto&, const char*) {
    line += ' ';
    line += name;
  });
  return line;
}

std::string row_text(const DriveCounts& counts) {
  std::string line;
  DriveCounts::visit(counts, [&](const char*, const auto& value, const char*) {
    line += value_text(value) + ' ';
  });
  return line.append(kRowEnd);
}

bool read_row(const std::string& line, DriveCounts& counts) {
  std::istringstream words(line);
  std::string word;
  bool fits = true;
  DriveCounts::visit(counts, [&](const char*, auto& value, const char*) {
    fits = fits && words >> word && read_value(word, value);
  });
  return fits && words >> word && word == kRowEnd && !(words >> word);
}

/// What follows "# name " in a line; empty where the line is another.
std::string header_value(const std::string& line, std::string_view name) {
  const std::string start = fmt::format("# {} ", name);
  return line.compare(0, start.size(), start) == 0 ? line.substr(start.size()) : "";
}

}  // namespace

std::string format_results(const CellResults& results) {
  const ResultsHeader& header = results.header;
  std::string text =
      fmt::format("# cell {}\n# definitions {}\n# seed {}\n# settings {}\n{}\n", header.cell,
                  header.definitions, header.seed, header.settings, names_line());
  for (const DriveCounts& counts : results.drives) text += row_text(counts) + '\n';
  return text;
}

Result<CellResults> parse_results(std::string_view text) {
  std::istringstream lines{std::string(text)};
  std::string line;
  CellResults results;
  ResultsHeader& header = results.header;
  const auto next = [&](std::string_view name) {
    return std::getline(lines, line) ? header_value(line, name) : std::string();
  };
  header.cell = next("cell");
  const bool is_header = !header.cell.empty() &&
                         read_value(next("definitions"), header.definitions) &&
                         read_value(next("seed"), header.seed);
  header.settings = next("settings");
  if (!is_header || header.settings.empty()) return fail("no header of a campaign's results");
  if (!std::getline(lines, line) || line != names_line()) {
    return fail("columns of another version of the campaign");
  }
  while (std::getline(lines, line)) {
    DriveCounts counts;
    if (read_row(line, counts)) results.drives.push_back(std::move(counts));
  }
  std::sort(results.drives.begin(), results.drives.end(),
            [](const DriveCounts& a, const DriveCounts& b) { return a.drive < b.drive; });
  return results;
}

std::string results_path(const std::string& folder, std::string_view cell) {
  return fmt::format("{}/{}.txt", folder, cell);
}

Result<CellResults> read_results(const std::string& folder, std::string_view cell) {
  const std::string path = results_path(folder, cell);
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) return fail(path + ": cannot be read");
  return parse_results(text.str());
}

Result<void> write_results(const CellResults& results, const std::string& folder) {
  return write_file(results_path(folder, results.header.cell), format_results(results));
}

}  // namespace adit
