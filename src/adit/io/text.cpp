#include "adit/io/text.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>

namespace adit {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_comma(char c) { return c == ',' || c == ';'; }

inline const char* after_blanks(const char* at, const char* end) {
  while (at != end && is_blank(*at)) ++at;
  return at;
}

/// Past the blanks and the one comma that may stand between two fields.
inline const char* after_separator(const char* at, const char* end) {
  at = after_blanks(at, end);
  return at != end && is_comma(*at) ? after_blanks(at + 1, end) : at;
}

/// Appends the decimal digits at `at`; more than 19 overflow, which the caller must not accept.
const char* parse_digits(const char* at, const char* end, std::uint64_t& digits) {
  for (; at != end; ++at) {
    const auto digit = static_cast<unsigned char>(*at - '0');
    if (digit > 9) break;
    digits = 10 * digits + digit;
  }
  return at;
}

/// Plain decimals of at most 15 digits, which are nearly all numbers of plans and logs: both the
/// digits and the power of ten are exact doubles, so one division rounds correctly (Clinger 1990).
const char* parse_plain(const char* at, const char* end, double& value) {
  static constexpr std::array<double, 16> kPowers = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                     1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const bool negative = at != end && *at == '-';
  if (negative) ++at;
  std::uint64_t digits = 0;
  const char* next = parse_digits(at, end, digits);
  std::ptrdiff_t count = next - at;
  std::ptrdiff_t decimals = 0;
  if (next != end && *next == '.') {
    const char* first = next + 1;
    next = parse_digits(first, end, digits);
    decimals = next - first;
    count += decimals;
  }
  if (count == 0 || count > 15 || (next != end && !is_blank(*next) && !is_comma(*next)))
    return nullptr;
  value = static_cast<double>(static_cast<std::int64_t>(digits));
  if (decimals > 0) value /= kPowers[static_cast<std::size_t>(decimals)];
  if (negative) value = -value;
  return next;
}

/// Any number; a magnitude that no double holds becomes an infinity or zero.
const char* parse_any(const char* at, const char* end, double& value) {
  if (at != end && *at == '+') {
    ++at;
    if (at != end && *at == '-') return nullptr;
  }
  const auto [next, status] = std::from_chars(at, end, value);
  if (status == std::errc::invalid_argument) return nullptr;
  if (status == std::errc::result_out_of_range) {
    const std::string_view text(at, static_cast<std::size_t>(next - at));
    const bool tiny = text.find("e-") != text.npos || text.find("E-") != text.npos;
    value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    if (!tiny && *at == '-') value = -value;
  }
  if (next != end && !is_blank(*next) && !is_comma(*next)) return nullptr;
  return next;
}

const char* parse_number(const char* at, const char* end, double& value) {
  const char* next = parse_plain(at, end, value);
  return next != nullptr ? next : parse_any(at, end, value);
}

Error system_error(const std::string& path, const char* what) {
  return {std::string(what) + ": " + std::strerror(errno), path, 0};
}

}  // namespace

Result<std::string> read_text(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return fail("expected a file, not a directory", path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) return tl::unexpected(system_error(path, "cannot open"));
  constexpr std::size_t kLimit = std::size_t{4} << 30;
  const auto size = std::filesystem::file_size(path, ignored);
  std::string text;
  std::size_t used = 0;
  text.resize(ignored || size > kLimit ? 65536 : static_cast<std::size_t>(size) + 1);
  while (true) {
    const std::size_t got = std::fread(text.data() + used, 1, text.size() - used, file.get());
    used += got;
    if (std::ferror(file.get()) != 0) return tl::unexpected(system_error(path, "cannot read"));
    if (used < text.size()) break;
    if (used >= kLimit) return fail("larger than 4 GiB", path);
    text.resize(2 * text.size());
  }
  text.resize(used);
  return text;
}

Result<void> check_text(std::string_view text, const std::string& file) {
  if (text.empty()) return fail("the file is empty", file);
  const bool utf16 = text.substr(0, 2) == "\xff\xfe" || text.substr(0, 2) == "\xfe\xff";
  const std::size_t nul = text.find('\0');
  if (utf16 || nul != text.npos) {
    long line = 1;
    for (const char c : text.substr(0, utf16 ? 0 : nul)) line += c == '\n' ? 1 : 0;
    return fail("expected a text file (UTF-8), found binary data", file, line);
  }
  return {};
}

Lines::Lines(std::string_view text) : rest_(text) {
  if (rest_.substr(0, 3) == "\xef\xbb\xbf") rest_.remove_prefix(3);
}

bool Lines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const void* found = std::memchr(rest_.data(), '\n', rest_.size());
  const std::size_t length =
      found == nullptr ? rest_.size()
                       : static_cast<std::size_t>(static_cast<const char*>(found) - rest_.data());
  line = rest_.substr(0, length);
  rest_.remove_prefix(found == nullptr ? length : length + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ++number_;
  return true;
}

bool Fields::next(std::string_view& field) {
  at_ = after_blanks(at_, end_);
  if (at_ == end_) return false;
  const char* begin = at_;
  while (at_ != end_ && !is_blank(*at_) && !is_comma(*at_)) ++at_;
  field = {begin, static_cast<std::size_t>(at_ - begin)};
  at_ = after_separator(at_, end_);
  return true;
}

bool Fields::next(double& value) {
  at_ = after_blanks(at_, end_);
  const char* after = at_ == end_ ? nullptr : parse_number(at_, end_, value);
  if (after == nullptr) return false;
  at_ = after_separator(after, end_);
  return true;
}

std::optional<double> to_number(std::string_view field) {
  double value = 0.0;
  const char* end = field.data() + field.size();
  if (field.empty() || parse_number(field.data(), end, value) != end) return std::nullopt;
  return value;
}

std::optional<std::string> read_row(std::string_view line, std::span<double> values) {
  Fields fields(line);
  for (std::size_t i = 0; i < values.size(); ++i) {
    Fields before = fields;
    if (fields.next(values[i])) {
      if (std::isfinite(values[i])) continue;
      return "a number that is not finite";
    }
    std::string_view field;
    if (before.next(field)) return in_quotes(field);
    return i == 1 ? "only 1 field" : "only " + std::to_string(i) + " fields";
  }
  std::size_t extra = 0;
  for (std::string_view field; fields.next(field);) ++extra;
  if (extra > 0) return std::to_string(values.size() + extra) + " fields";
  return std::nullopt;
}

std::string_view strip_comment(std::string_view line) {
  line = line.substr(0, line.find('#'));
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 32;
  std::string out = "\"";
  for (const char c : text.substr(0, kLongest)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (text.size() > kLongest ? "...\"" : "\"");
}

}  // namespace adit
