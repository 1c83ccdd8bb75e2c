#include "survey_call.hpp"

#include <charconv>
#include <filesystem>
#include <string_view>

#include "adit/io/plan.hpp"
#include "adit/io/text.hpp"
#include "adit/plot/figures.hpp"
#include "parse_pose.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr int kMostChanges = 1'000'000;

/// Long work should not end at a folder that is not there.
Result<void> check_folder(const std::string& path) {
  if (path.empty()) return {};
  const fs::path folder = fs::path(path).parent_path();
  std::error_code code;
  if (folder.empty() || fs::is_directory(folder, code)) return {};
  return fail("no such folder: " + folder.string(), path);
}

Result<void> check_ending(const std::string& path, std::string_view what,
                          std::initializer_list<std::string_view> endings) {
  if (path.empty()) return {};
  std::string wanted;
  for (const std::string_view ending : endings) {
    if (path.ends_with(ending)) return {};
    wanted += (wanted.empty() ? "" : " or ") + std::string(ending);
  }
  return fail(std::string(what) + " must end in " + wanted + ", not as in " + in_quotes(path));
}

/// Else the later would take the place of the earlier.
Result<void> check_names_differ(std::initializer_list<std::string> paths) {
  std::set<fs::path> names;
  for (const std::string& path : paths) {
    if (path.empty()) continue;
    std::error_code code;
    if (!names.insert(fs::weakly_canonical(fs::absolute(path), code)).second) {
      return fail("two outputs go to " + in_quotes(path));
    }
  }
  return {};
}

/// What is read stays as it is; but for the plan that `--apply` changes.
Result<void> check_inputs_stay(const SurveyArguments& a) {
  const auto is_same = [](const std::string& one, const std::string& other) {
    std::error_code code;
    return !one.empty() && !other.empty() && fs::equivalent(one, other, code);
  };
  for (const std::string& input : {a.log, a.poses, a.update, a.config}) {
    for (const std::string& output : {a.output, a.trajectory, a.walls, a.report, a.picture}) {
      const bool is_changed_plan = !a.apply.empty() && output == a.output && input == a.update;
      if (is_same(input, output) && !is_changed_plan) {
        return fail("an output would take the place of what is read: " + in_quotes(output));
      }
    }
  }
  return {};
}

Result<void> check_outputs(const SurveyArguments& a) {
  for (const std::string& path : {a.output, a.trajectory, a.walls, a.report, a.picture}) {
    if (auto checked = check_folder(path); !checked) return checked;
  }
  if (auto checked = check_names_differ({a.output, a.trajectory, a.walls, a.report, a.picture});
      !checked) {
    return checked;
  }
  if (auto checked = check_inputs_stay(a); !checked) return checked;
  if (auto checked = check_ending(a.walls, "--walls", {".csv"}); !checked) return checked;
  if (!a.picture.empty()) {
    if (const auto named = check_picture_name(a.picture); !named) {
      return fail(to_string(named.error()));
    }
  }
  if (!a.update.empty() && a.apply.empty()) {
    return check_ending(a.output, "the list of changes", {".json", ".csv"});
  }
  if (const auto named = check_plan_name(a.output); !named) return fail(to_string(named.error()));
  return {};
}

std::optional<int> number_in(std::string_view text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, number);
  if (code != std::errc{} || rest != end || number < 1 || number > kMostChanges) return {};
  return number;
}

}  // namespace

Result<std::set<int>> parse_numbers(const std::string& text) {
  const auto wrong = [&] {
    return fail("expected \"all\" or numbers of changes as in 1,3-5, not " + in_quotes(text));
  };
  std::set<int> numbers;
  std::string_view rest = text;
  while (true) {
    const std::string_view part = rest.substr(0, rest.find(','));
    const std::size_t dash = part.find('-');
    const auto first = number_in(part.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : number_in(part.substr(dash + 1));
    if (!first || !last || *last < *first) return wrong();
    for (int i = *first; i <= *last; ++i) numbers.insert(i);
    if (part.size() == rest.size()) return numbers;
    rest.remove_prefix(part.size() + 1);
  }
}

Result<SurveyCall> survey_call(const SurveyArguments& arguments) {
  SurveyCall call;
  if (arguments.update.empty()) {
    if (!arguments.apply.empty()) return fail("--apply needs --update, the plan to change");
    if (arguments.start) return fail("--start needs --update, the plan that it lies in");
  }
  if (arguments.start && !arguments.poses.empty()) {
    return fail("--start and --poses exclude each other");
  }
  if (arguments.start) {
    const auto pose = parse_pose(*arguments.start);
    if (!pose) return tl::unexpected(pose.error());
    call.start = *pose;
  }
  if (!arguments.apply.empty()) {
    call.applies = true;
    call.applies_all = arguments.apply == "all";
    if (!call.applies_all) {
      auto numbers = parse_numbers(arguments.apply);
      if (!numbers) return tl::unexpected(numbers.error());
      call.changes = std::move(*numbers);
    }
  }
  if (auto checked = check_outputs(arguments); !checked) {
    return tl::unexpected(checked.error());
  }
  return call;
}

}  // namespace adit
