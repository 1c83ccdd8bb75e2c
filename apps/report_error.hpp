#pragma once

#include <cstdio>
#include <string>

#include "adit/geometry/result.hpp"
#include "commands.hpp"

namespace adit {

/// Says on stderr what went wrong and where, and returns the exit status for it.
inline int report(const Error& error, int status = kFailed) {
  std::fprintf(stderr, "adit: %s\n", to_string(error).c_str());
  return status;
}

}  // namespace adit
