#pragma once

#include <string>

#include "adit/config/configuration.hpp"
#include "adit/io/carmen.hpp"

namespace adit {

/// The configuration of `--config`; the defaults where none is given.
Result<LoadedConfiguration> load_configuration(const std::string& path);

/// What a configuration knows better than the logs read under it.
LogOptions log_options(const LoadedConfiguration& configuration);

}  // namespace adit
