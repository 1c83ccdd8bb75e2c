#pragma once

#include <string>
#include <string_view>

#include "adit/geometry/result.hpp"

namespace adit {

/// Writes a picture's bytes whole or not at all: into a neighbour, which then takes the name. A
/// failure leaves an older file of that name as it was.
Result<void> write_picture_file(const std::string& path, std::string_view bytes);

}  // namespace adit
