#include "configured.hpp"

namespace adit {

Result<LoadedConfiguration> load_configuration(const std::string& path) {
  if (path.empty()) return LoadedConfiguration{};
  return read_configuration(path);
}

LogOptions log_options(const LoadedConfiguration& configuration) {
  LogOptions options;
  if (configuration.has("scanner.max_range_m"))
    options.max_range_m = configuration.values.localizer.scanner.max_range_m;
  return options;
}

}  // namespace adit
