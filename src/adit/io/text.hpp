#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "adit/geometry/result.hpp"

namespace adit {

/// The whole text of a file. Errors: it cannot be read, is a directory, is larger than 4 GiB.
Result<std::string> read_text(const std::string& path);

/// Error when the text is empty or holds bytes that no text holds (a NUL, a UTF-16 mark).
Result<void> check_text(std::string_view text, const std::string& file);

/// Walks through the lines of a text: any line end of `\n` or `\r\n`, a byte order mark skipped.
class Lines {
 public:
  explicit Lines(std::string_view text);

  /// The next line without its end; false after the last one.
  bool next(std::string_view& line);

  /// Number of the line that `next` gave last, from 1.
  long number() const { return number_; }

 private:
  std::string_view rest_;
  long number_ = 0;
};

/// Takes a line apart: fields between blanks, or between single commas or semicolons.
///
/// A field is never empty for the blank-separated form; "1,,2" has an empty field in the middle,
/// and a comma after the last field adds none.
class Fields {
 public:
  explicit Fields(std::string_view line) : at_(line.data()), end_(line.data() + line.size()) {}

  /// The next field; false at the end of the line.
  bool next(std::string_view& field);

  /// The next field as a number, which may be `inf` or `nan`; false if it is missing or is no
  /// number.
  bool next(double& value);

  /// Characters that are left: an upper bound on how many fields can follow.
  std::size_t characters_left() const { return static_cast<std::size_t>(end_ - at_); }

 private:
  const char* at_;
  const char* end_;
};

/// The field as a number (decimal point, optional sign and exponent, `inf`, `nan`), if it is one.
std::optional<double> to_number(std::string_view field);

/// Reads a row that must hold exactly `values.size()` finite numbers; else says what was found.
std::optional<std::string> read_row(std::string_view line, std::span<double> values);

/// The line without what follows a `#` and without blanks at both ends.
std::string_view strip_comment(std::string_view line);

/// The text in quotes for a message: shortened, unprintable bytes replaced.
std::string in_quotes(std::string_view text);

}  // namespace adit
