#include "trial_options.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <system_error>
#include <type_traits>

#include "adit/simulation/scanner.hpp"

namespace adit {
namespace {

constexpr int kMost = 100000000;

/// The whole text as a number.
template <class Number>
bool read_number(std::string_view text, Number& value) {
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  return parsed.ec == std::errc{} && parsed.ptr == end;
}

// Each `read` returns what it expected where the text is something else, and else nothing.

std::string read(std::string_view text, std::string& value) {
  value = text;
  return text.empty() ? "a word" : "";
}

std::string read(std::string_view text, int& value) {
  return read_number(text, value) && value >= 0 && value <= kMost ? "" : "a whole number";
}

std::string read(std::string_view text, std::uint64_t& value) {
  return read_number(text, value) ? "" : "a whole number";
}

std::string read(std::string_view text, double& value) {
  return read_number(text, value) && std::isfinite(value) && value >= 0.0
             ? ""
             : "a number of at least 0";
}

template <class Value>
std::string read(std::string_view text, std::optional<Value>& value) {
  return read(text, value.emplace());
}

template <class Enum>
std::string words_of() {
  std::string all;
  for (const std::string_view word : kWords<Enum>) {
    all += all.empty() ? "" : "|";
    all += word;
  }
  return all;
}

template <class Enum>
requires std::is_enum_v<Enum> std::string read(std::string_view text, Enum& value) {
  for (std::size_t i = 0; i < kWords<Enum>.size(); ++i) {
    if (kWords<Enum>[i] != text) continue;
    value = static_cast<Enum>(i);
    return "";
  }
  return words_of<Enum>();
}

template <class Value>
std::string write(const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    return std::string(word_of(value));
  } else {
    return fmt::format("{}", value);
  }
}

template <class Value>
std::string write(const std::optional<Value>& value) {
  return value ? write(*value) : "usual";
}

Result<void> read_word(std::string_view word, TrialOptions& options) {
  const std::size_t equals = word.find('=');
  const std::string_view name = word.substr(0, equals);
  bool known = false;
  std::string expected;
  TrialOptions::visit(options, [&](std::string_view candidate, auto& value, const char*) {
    if (candidate != name) return;
    known = true;
    const std::string_view text = equals < word.size() ? word.substr(equals + 1) : "";
    expected = read(text, value);
  });
  if (!known) return fail(fmt::format("'{}': no such name", word));
  if (!expected.empty()) return fail(fmt::format("'{}': expected {}={}", word, name, expected));
  return {};
}

Result<void> check(const TrialOptions& options) {
  if (!scanner_named(options.scanner)) {
    return fail("'" + options.scanner + "': no such scanner; cyclone, sick, sick_lms, hokuyo");
  }
  const std::string& sigma = options.map_sigma;
  if (sigma != "plan" && sigma != "unknown" && !options.stated_map_sigma()) {
    return fail("'map_sigma=" + sigma + "': expected plan, unknown or a number of at least 0");
  }
  if (options.runs < 1) return fail("'runs=0': expected 1 or more");
  return {};
}

}  // namespace

std::optional<double> TrialOptions::stated_map_sigma() const {
  double value = 0.0;
  return read(map_sigma, value).empty() ? std::optional(value) : std::nullopt;
}

bool TrialOptions::stops() const {
  const bool usual =
      world == TrialWorld::mockup || world == TrialWorld::stress || mode == TrialMode::single;
  return speed ? *speed == 0.0 : usual;
}

Result<TrialOptions> parse_trial(std::span<char* const> words) {
  TrialOptions options;
  for (const char* word : words) {
    if (const auto done = read_word(word, options); !done) return tl::unexpected(done.error());
  }
  if (const auto fine = check(options); !fine) return tl::unexpected(fine.error());
  return options;
}

std::string trial_usage() {
  std::string text = "usage: estimator_trials [name=value]...\n";
  const TrialOptions defaults;
  TrialOptions::visit(defaults, [&](const char* name, const auto& value, const char* what) {
    text += fmt::format("  {:<10} {} (default {})\n", name, what, write(value));
  });
  text += fmt::format("worlds {}\nestimators {}\nmodes {}\n", words_of<TrialWorld>(),
                      words_of<Estimator>(), words_of<TrialMode>());
  return text;
}

std::string to_text(const TrialOptions& options) {
  std::string text;
  TrialOptions::visit(options, [&](const char* name, const auto& value, const char*) {
    if (write(value) != "usual") text += fmt::format("{}={} ", name, write(value));
  });
  return text;
}

}  // namespace adit
