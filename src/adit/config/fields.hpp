#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "adit/config/configuration.hpp"
#include "adit/config/enum_names.hpp"

namespace adit {

/// A field whose values are words.
struct WordField {
  std::vector<std::string> words;
  std::function<std::string()> get;
  std::function<void(const std::string&)> set;  ///< takes one of the words
};

/// A key of the configuration, joined to the field of the options behind it.
struct ConfigField {
  std::string table;
  std::string key;
  std::string documentation;
  std::variant<double*, int*, bool*, WordField> target;

  std::string name() const { return table + "." + key; }
};

/// A table of the configuration.
struct ConfigTable {
  std::string name;
  std::string documentation;
};

/// Joins an enumeration to its words.
template <class Enum>
WordField word_field(Enum& value) {
  WordField out;
  for (const auto& entry : EnumNames<Enum>::values) out.words.emplace_back(entry.first);
  out.get = [&value] { return std::string(word_of(value)); };
  out.set = [&value](const std::string& word) {
    if (const auto named = value_named<Enum>(word)) value = *named;
  };
  return out;
}

/// All keys of a configuration, which must outlive them, in the order of its visits.
std::vector<ConfigField> fields_of(Configuration& configuration);

/// All tables, each once.
std::vector<ConfigTable> config_tables();

/// The field's value as TOML writes it.
std::string value_text(const ConfigField& field);

}  // namespace adit
