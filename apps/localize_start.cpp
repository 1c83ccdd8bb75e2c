#include "localize_start.hpp"

#include "adit/io/text.hpp"
#include "mine_levels.hpp"
#include "parse_pose.hpp"

namespace adit {
namespace {

constexpr const char* kAnywhere = "anywhere";

Result<Start> resumed(const LocalizeArguments& arguments) {
  if (arguments.start) return fail("--start and --resume exclude each other");
  ResumeOptions options;
  if (arguments.moved.size() == 2) {
    options = {arguments.moved[0], radians(arguments.moved[1])};
  }
  const auto saved = read_saved_pose(arguments.resume);
  if (!saved) return tl::unexpected(saved.error());
  if (!arguments.level.empty() && !saved->level.empty() && saved->level != arguments.level) {
    return fail(
        "is a pose on level " + in_quotes(saved->level) + ", not on " + in_quotes(arguments.level),
        arguments.resume);
  }
  return Start{beginning_at(*saved, options), "resumed",
               arguments.level.empty() ? saved->level : arguments.level};
}

}  // namespace

Beginning beginning_at(const SavedPose& saved, const ResumeOptions& options) {
  if (!saved.is_known()) return {true, std::nullopt, std::nullopt};
  const Vector3d moved(options.moved_m, options.moved_m, options.turned_rad);
  const Matrix3d grown = saved.covariance + Matrix3d(moved.cwiseAbs2().asDiagonal());
  return {false, saved.pose, grown};
}

Result<Start> start_of(const LocalizeArguments& arguments) {
  if (!arguments.resume.empty()) return resumed(arguments);
  if (!arguments.start) return Start{{}, "odometry", arguments.level};
  if (*arguments.start == kAnywhere) {
    return Start{{true, std::nullopt, std::nullopt}, kAnywhere, arguments.level};
  }
  const Result<Pose2> pose = parse_pose(*arguments.start);
  if (!pose) return fail(pose.error().message + ", or anywhere");
  return Start{{false, *pose, std::nullopt}, "given", arguments.level};
}

Result<std::optional<std::size_t>> level_of(const std::vector<PlanLevel>& plans,
                                            const Start& start) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (!start.level.empty() && plans[i].name == start.level) return i;
  }
  const bool has_levels = !plans.front().name.empty();
  if (!start.level.empty()) {
    return fail("no level " + in_quotes(start.level) + ": " +
                (has_levels ? "the plan has " + names_of(plans) : "the plan is a single file"));
  }
  if (plans.size() == 1) return std::optional<std::size_t>(0);
  if (start.beginning.is_anywhere) return std::optional<std::size_t>();
  return fail("the plan has the levels " + names_of(plans) +
              ": name one with --level, or let --start anywhere find it");
}

}  // namespace adit
