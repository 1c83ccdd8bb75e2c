#pragma once

#include <string>
#include <vector>

namespace adit {

/// Something odd in a file that did not stop the reading: how often, and on which line first.
struct Warning {
  std::string message;
  long count = 0;
  long first_line = 0;
};

/// Counts one more occurrence; the same message is kept once, with its first line.
inline void count_warning(std::vector<Warning>& warnings, std::string message, long line) {
  for (Warning& warning : warnings) {
    if (warning.message == message) {
      ++warning.count;
      return;
    }
  }
  warnings.push_back({std::move(message), 1, line});
}

/// `line 12: message (3 times)`.
inline std::string to_string(const Warning& warning) {
  std::string text = "line " + std::to_string(warning.first_line) + ": " + warning.message;
  if (warning.count > 1) text += " (" + std::to_string(warning.count) + " times)";
  return text;
}

}  // namespace adit
