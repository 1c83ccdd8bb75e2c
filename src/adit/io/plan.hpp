#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "adit/geometry/result.hpp"
#include "adit/geometry/segment.hpp"
#include "adit/io/warning.hpp"

namespace adit {

/// The walls of a plan as its file gives them (m), in the file's order, and what was odd about
/// them.
struct Plan {
  std::vector<Segment> segments;
  std::vector<Warning> warnings;
};

/// Reads a plan of the form `x1,y1,x2,y2` a line (`.csv`, `.vectormap.txt`, `.txt` or no ending).
///
/// Comments start with `#`; a header row, blanks, tabs or semicolons between the numbers are
/// allowed. Errors name the line and what was expected: a row that is not four finite numbers below
/// 1e9 m in size, no row at all, binary data, an ending of a form that is not supported.
Result<Plan> read_plan(const std::string& path);

/// The same from text; `file` is the name in errors.
Result<Plan> parse_plan(std::string_view text, const std::string& file = {});

/// Whether a plan of that name could be written: its ending is of a form that is supported.
Result<void> check_plan_name(const std::string& path);

/// Writes `x1,y1,x2,y2` a line with all digits, whole or not at all. Errors: a segment is not
/// finite, or the ending is of a form that is not supported.
Result<void> write_plan(std::span<const Segment> segments, const std::string& path);

}  // namespace adit
