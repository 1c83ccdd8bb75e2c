#include "locate_options.hpp"

#include <fmt/core.h>

#include <charconv>
#include <string_view>

namespace adit {
namespace {

template <class Value>
bool read(std::string_view text, Value& value) {
  if constexpr (std::is_same_v<Value, std::string>) {
    value = text;
    return !text.empty();
  } else {
    const char* end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    return parsed.ec == std::errc{} && parsed.ptr == end && value >= Value{0};
  }
}

}  // namespace

Result<LocateOptions> parse_locate(std::span<char* const> words) {
  LocateOptions options;
  for (const std::string_view word : words) {
    const std::size_t equals = word.find('=');
    const std::string_view text = equals < word.size() ? word.substr(equals + 1) : "";
    bool fits = false;
    LocateOptions::visit(options, [&](const char* name, auto& value, const char*) {
      if (name == word.substr(0, equals)) fits = read(text, value);
    });
    if (!fits) return fail(fmt::format("'{}': expected name=value of the list below", word));
  }
  return options;
}

std::string locate_usage() {
  std::string text = "usage: locate_trials [name=value]...\n";
  const LocateOptions defaults;
  LocateOptions::visit(defaults, [&](const char* name, const auto& value, const char* what) {
    text += fmt::format("  {:<10} {} (default {})\n", name, what, value);
  });
  return text;
}

}  // namespace adit
