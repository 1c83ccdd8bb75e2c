#include <fmt/core.h>

#include "adit/config/configuration.hpp"
#include "commands.hpp"

namespace adit {

int run_config(bool reference) {
  fmt::print("{}", reference ? configuration_reference() : format_configuration({}));
  return kDone;
}

}  // namespace adit
