#include "adit/config/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace adit {
namespace {

template <class T>
std::variant<double*, int*, bool*, WordField> target_of(T& value) {
  if constexpr (std::is_enum_v<T>) {
    return word_field(value);
  } else {
    return &value;
  }
}

/// A float in TOML needs a point or an exponent.
std::string float_text(double value) {
  std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == text.npos ? text + ".0" : text;
}

}  // namespace

std::vector<ConfigField> fields_of(Configuration& configuration) {
  std::vector<ConfigField> fields;
  Configuration::visit(configuration, [&](const char* table, auto& options, const char*) {
    std::decay_t<decltype(options)>::visit(
        options, [&](const char* key, auto& value, const char* documentation) {
          fields.push_back({table, key, documentation, target_of(value)});
        });
  });
  return fields;
}

std::vector<ConfigTable> config_tables() {
  std::vector<ConfigTable> tables;
  Configuration defaults;
  Configuration::visit(defaults, [&](const char* name, auto&, const char* documentation) {
    const auto known = std::find_if(tables.begin(), tables.end(),
                                    [&](const ConfigTable& t) { return t.name == name; });
    if (known == tables.end()) {
      tables.push_back({name, documentation});
    } else if (known->documentation.empty()) {
      known->documentation = documentation;
    }
  });
  return tables;
}

std::string value_text(const ConfigField& field) {
  if (const auto* number = std::get_if<double*>(&field.target)) return float_text(**number);
  if (const auto* count = std::get_if<int*>(&field.target)) return std::to_string(**count);
  if (const auto* flag = std::get_if<bool*>(&field.target)) return **flag ? "true" : "false";
  return "\"" + std::get<WordField>(field.target).get() + "\"";
}

}  // namespace adit
