#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

namespace adit {

/// A whole number of at least `least`, as an argument of a program gives it.
inline std::optional<std::int64_t> whole_number(std::string_view text, std::int64_t least,
                                                std::int64_t most) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  if (parsed.ec != std::errc{} || parsed.ptr != end || value < least || value > most)
    return std::nullopt;
  return value;
}

}  // namespace adit
