#pragma once

#include <string>
#include <string_view>

#include "adit/geometry/result.hpp"

namespace adit {

/// Writes a file whole or not at all: into a neighbour first, which then takes the name.
///
/// A failure leaves an older file of that name as it was. What is no regular file (a terminal, a
/// pipe) is written straight away; a symbolic link stays and its target is replaced.
Result<void> write_file(const std::string& path, std::string_view contents);

}  // namespace adit
