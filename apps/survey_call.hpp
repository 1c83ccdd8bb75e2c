#pragma once

#include <optional>
#include <set>
#include <string>

#include "adit/geometry/pose2.hpp"
#include "adit/geometry/result.hpp"
#include "commands.hpp"

namespace adit {

/// What the call of `adit survey` asks for beside its files.
struct SurveyCall {
  bool applies = false;        ///< whether changes are made
  bool applies_all = false;    ///< all of them
  std::set<int> changes;       ///< else these, from 1
  std::optional<Pose2> start;  ///< in the plan that is updated
};

/// Checks the call before any file is read. An Error without a file is one of the call.
Result<SurveyCall> survey_call(const SurveyArguments& arguments);

/// Reads "1,3-5": whole numbers from 1, ranges of them, commas between.
Result<std::set<int>> parse_numbers(const std::string& text);

}  // namespace adit
