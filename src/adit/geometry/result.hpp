#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace adit {

/// What went wrong with data from outside, and where: `file` is empty and `line` 0 when unknown.
struct Error {
  std::string message;
  std::string file;
  long line = 0;
};

/// `file:line: message`, without the parts that are unknown.
inline std::string to_string(const Error& error) {
  std::string text = error.file;
  if (error.line > 0) text += ":" + std::to_string(error.line);
  return text.empty() ? error.message : text + ": " + error.message;
}

/// A value, or the reason why there is none.
template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand for returning an Error from a function that returns a Result.
inline tl::unexpected<Error> fail(std::string message, std::string file = {}, long line = 0) {
  return tl::unexpected<Error>(Error{std::move(message), std::move(file), line});
}

}  // namespace adit
