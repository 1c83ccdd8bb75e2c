#include "adit/config/toml.hpp"

#include <toml++/toml.h>

#include <algorithm>

namespace adit {
namespace {

TomlValue to_value(const toml::node& node) {
  if (const auto* value = node.as_boolean()) return value->get();
  if (const auto* value = node.as_integer()) return value->get();
  if (const auto* value = node.as_floating_point()) return value->get();
  if (const auto* value = node.as_string()) return value->get();
  return std::monostate{};
}

std::vector<TomlEntry> to_entries(const toml::table& root) {
  std::vector<TomlEntry> entries;
  for (auto&& [name, node] : root) {
    const std::string table(name.str());
    const long line = name.source().begin.line;
    const toml::table* members = node.as_table();
    if (members == nullptr) {
      entries.push_back({"", table, to_value(node), line});
      continue;
    }
    entries.push_back({table, "", {}, line});
    for (auto&& [key, value] : *members)
      entries.push_back({table, std::string(key.str()), to_value(value), key.source().begin.line});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const TomlEntry& a, const TomlEntry& b) { return a.line < b.line; });
  return entries;
}

}  // namespace

Result<std::vector<TomlEntry>> parse_toml(std::string_view text, const std::string& file) {
  try {
    return to_entries(toml::parse(text));
  } catch (const toml::parse_error& error) {
    return fail("expected TOML: " + std::string(error.description()), file,
                error.source().begin.line);
  } catch (const std::exception& error) {
    return fail(std::string("expected TOML: ") + error.what(), file);
  }
}

}  // namespace adit
