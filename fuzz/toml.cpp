// A configuration is read or refused; what is read can be written and reads back the same.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "adit/config/configuration.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto read =
      adit::parse_configuration({reinterpret_cast<const char*>(data), size}, "c.toml");
  if (!read) return 0;
  const std::string text = adit::format_configuration(read->values);
  const auto again = adit::parse_configuration(text);
  if (!again || adit::format_configuration(again->values) != text) std::abort();
  return 0;
}
