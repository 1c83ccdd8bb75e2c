#pragma once

#include <string>

#include "adit/geometry/result.hpp"
#include "adit/simulation/as_built.hpp"
#include "commands.hpp"

namespace adit {

/// Reads `--as-built`: `key=number,…` with the keys bend, reach, rough, missing, added, chains,
/// offset and distortion, each once at most.
Result<AsBuiltOptions> parse_as_built(const std::string& text);

/// Makes the mine differ from its plan as the call says. Returns how far the plan lies from the
/// mine, one sigma (m), for the estimator's configuration.
Result<double> change_world(const SimulateArguments& arguments, World& world);

/// Puts in the clutter and the ramps that the call asks for; says on stderr where there was no room
/// for all of them. An Error where the kind is none.
Result<void> furnish(const SimulateArguments& arguments, World& world);

}  // namespace adit
