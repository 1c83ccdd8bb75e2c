#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "adit/geometry/result.hpp"

namespace adit {

/// A value of a TOML file; monostate for what no configuration uses (an array, a date, a table).
using TomlValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

/// `key = value` in a table, and its line. A table itself is an entry without a key; a key that
/// stands in no table has an empty table.
struct TomlEntry {
  std::string table;
  std::string key;
  TomlValue value;
  long line = 0;
};

/// The entries of a TOML text, by line. Error: it is not TOML, with the line.
Result<std::vector<TomlEntry>> parse_toml(std::string_view text, const std::string& file);

}  // namespace adit
