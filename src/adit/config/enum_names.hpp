#pragma once

#include <array>
#include <utility>

#include "adit/estimation/estimation.hpp"
#include "adit/matching/matching.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// The words for the values of an enumeration in a configuration: specialise it for each
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

}  // namespace adit
