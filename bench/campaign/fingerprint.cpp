#include "fingerprint.hpp"

#include <fmt/core.h>

#include <type_traits>

#include "adit/config/configuration.hpp"

namespace adit {
namespace {

std::uint64_t hashed(std::uint64_t hash, std::string_view text) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

template <class Value>
std::string text_of_value(const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    return fmt::format("{}", static_cast<int>(value));
  } else {
    return fmt::format("{}", value);
  }
}

}  // namespace

std::string fingerprint_of(const Cell& cell, const LocalizerSettings& settings) {
  std::uint64_t hash = hashed(0xcbf29ce484222325u, text_of(cell));
  Configuration configuration;
  configuration.localizer = settings;
  Configuration::visit(configuration, [&](const char* table, auto& options, const char*) {
    if (std::string_view(table).starts_with("survey")) return;
    std::remove_reference_t<decltype(options)>::visit(
        options, [&](const char* key, auto& value, const char*) {
          hash = hashed(hash, fmt::format("{}.{}={};", table, key, text_of_value(value)));
        });
  });
  return fmt::format("{:016x}", hash);
}

}  // namespace adit
