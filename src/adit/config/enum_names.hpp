#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "adit/estimation/estimation.hpp"
#include "adit/localizer/settings.hpp"
#include "adit/matching/matching.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/survey/known_positions.hpp"

namespace adit {

/// The words for the values of an enumeration in a configuration or a call: specialise it for each
/// enumeration that an Options struct has a field of.
template <class Enum>
struct EnumNames;

template <>
struct EnumNames<SweepMoment> {
  static constexpr std::array<std::pair<const char*, SweepMoment>, 3> values = {
      {{"start", SweepMoment::start}, {"middle", SweepMoment::middle}, {"end", SweepMoment::end}}};
};

template <>
struct EnumNames<Consistency> {
  static constexpr std::array<std::pair<const char*, Consistency>, 2> values = {
      {{"clique", Consistency::clique}, {"paper", Consistency::paper}}};
};

template <>
struct EnumNames<Weighting> {
  static constexpr std::array<std::pair<const char*, Weighting>, 2> values = {
      {{"covariance", Weighting::covariance}, {"points", Weighting::points}}};
};

template <>
struct EnumNames<Estimator> {
  static constexpr std::array<std::pair<const char*, Estimator>, 3> values = {
      {{"features", Estimator::features},
       {"points", Estimator::points},
       {"full", Estimator::full}}};
};

template <>
struct EnumNames<GivenHeadings> {
  static constexpr std::array<std::pair<const char*, GivenHeadings>, 3> values = {
      {{"automatic", GivenHeadings::automatic},
       {"none", GivenHeadings::none},
       {"all", GivenHeadings::all}}};
};

/// The word for a value.
template <class Enum>
const char* word_of(Enum value) {
  for (const auto& [word, meaning] : EnumNames<Enum>::values) {
    if (meaning == value) return word;
  }
  return "";
}

/// The value that a word names, if it is one of the words.
template <class Enum>
std::optional<Enum> value_named(std::string_view word) {
  for (const auto& [known, value] : EnumNames<Enum>::values) {
    if (word == known) return value;
  }
  return std::nullopt;
}

}  // namespace adit
