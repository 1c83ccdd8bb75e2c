#include "adit/io/plan.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <iterator>

#include "adit/io/atomic_file.hpp"
#include "adit/io/text.hpp"

namespace adit {
namespace {

constexpr const char* kExpected = "expected x1,y1,x2,y2 (four numbers, metres)";
constexpr double kLargestCoordinate = 1e9;

/// A header names the columns: four fields or more, none of them a number.
bool is_header(std::string_view row) {
  Fields fields(row);
  int count = 0;
  for (std::string_view field; fields.next(field); ++count) {
    const bool is_name = std::all_of(field.begin(), field.end(), [](char c) {
      return std::isprint(static_cast<unsigned char>(c)) != 0;
    });
    if (field.empty() || !is_name || to_number(field)) return false;
  }
  return count >= 4;
}

}  // namespace

Result<void> check_plan_name(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending.empty() || ending == ".csv" || ending == ".txt") return {};
  return fail("plans of the form " + in_quotes(ending) +
                  " are not supported yet; expected .csv or .vectormap.txt",
              path);
}

Result<Plan> parse_plan(std::string_view text, const std::string& file) {
  if (const auto checked = check_text(text, file); !checked) return tl::unexpected(checked.error());
  Plan plan;
  Lines lines(text);
  bool header_allowed = true;
  for (std::string_view line; lines.next(line);) {
    const std::string_view row = strip_comment(line);
    if (row.empty()) continue;
    std::array<double, 4> v{};
    const auto found = read_row(row, v);
    const bool is_first = std::exchange(header_allowed, false);
    if (found) {
      if (is_first && is_header(row)) continue;
      return fail(std::string(kExpected) + ", found " + *found, file, lines.number());
    }
    if (std::any_of(v.begin(), v.end(), [](double x) { return std::abs(x) > kLargestCoordinate; }))
      return fail(std::string(kExpected) + ", found a coordinate beyond 1e9 m", file,
                  lines.number());
    const Segment segment{{v[0], v[1]}, {v[2], v[3]}};
    if (segment.a == segment.b) count_warning(plan.warnings, "wall of zero length", lines.number());
    plan.segments.push_back(segment);
  }
  if (plan.segments.empty())
    return fail(std::string("the plan holds no wall; ") + kExpected + " on a line", file,
                lines.number());
  return plan;
}

Result<Plan> read_plan(const std::string& path) {
  if (const auto known = check_plan_name(path); !known) return tl::unexpected(known.error());
  const auto text = read_text(path);
  if (!text) return tl::unexpected(text.error());
  return parse_plan(*text, path);
}

Result<void> write_plan(std::span<const Segment> segments, const std::string& path) {
  if (const auto known = check_plan_name(path); !known) return tl::unexpected(known.error());
  std::string text;
  for (const Segment& s : segments) {
    if (!s.is_finite()) return fail("a wall with a coordinate that is not finite", path);
    fmt::format_to(std::back_inserter(text), FMT_COMPILE("{},{},{},{}\n"), s.a.x(), s.a.y(),
                   s.b.x(), s.b.y());
  }
  return write_file(path, text);
}

}  // namespace adit
