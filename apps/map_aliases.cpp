#include <fmt/core.h>

#include "adit/io/plan.hpp"
#include "adit/plot/figures.hpp"
#include "adit/threads/share_out.hpp"
#include "alias_survey.hpp"
#include "commands.hpp"
#include "configured.hpp"
#include "mine_levels.hpp"
#include "openings.hpp"
#include "report_error.hpp"

namespace adit {
namespace {

struct Inputs {
  LoadedConfiguration configuration;
  Plan plan;
};

Result<Inputs> read_inputs(const AliasesArguments& arguments, const Configuration& base) {
  Inputs inputs{{base, {}}, {}};
  if (!arguments.config.empty()) {
    auto configuration = read_configuration(arguments.config, base);
    if (!configuration) return tl::unexpected(configuration.error());
    inputs.configuration = std::move(*configuration);
  }
  auto plan = read_plan(arguments.plan);
  if (!plan) return tl::unexpected(plan.error());
  inputs.plan = std::move(*plan);
  return inputs;
}

Result<void> draw(const std::string& path, const LineMap& map, const AliasSurvey& survey) {
  std::vector<AliasLink> links;
  for (const Alias& alias : survey.aliases) {
    links.push_back({alias.pose.translation(), alias.other.translation(), alias.weight});
  }
  return draw_aliases(path, plan_of(map), survey.places, links);
}

}  // namespace

int run_map_aliases(const AliasesArguments& arguments) {
  std::optional<ScannerSpec> scanner = scanner_named(arguments.scanner);
  if (!scanner) {
    return report({"no scanner '" + arguments.scanner + "': cyclone, sick, sick_lms, hokuyo", {}},
                  kWrongCall);
  }
  if (!arguments.output.empty()) {
    const auto named = check_picture_name(arguments.output);
    if (!named) return report(named.error(), kWrongCall);
  }
  Configuration base;
  base.localizer.scanner = scanner->model;
  const auto inputs = read_inputs(arguments, base);
  if (!inputs) return report(inputs.error());
  const LocalizerSettings& settings = inputs->configuration.values.localizer;
  scanner->model = settings.scanner;

  const int threads = threads_or_cores(arguments.threads.value_or(0));
  const LineMap map = LineMap::build(inputs->plan.segments, inputs->configuration.values.map);
  const auto index = index_of(map, {settings.places, threads, {}}, "");
  if (!index) return report(index.error());
  if ((*index)->pitch_m() > settings.places.coarsest_pitch_m) {
    return report({"the plan is too large for places to be laid out in it", arguments.plan});
  }
  const Openings openings = openings_of(map, **index, arguments.pitch, OpeningsOptions{});
  if (openings.places.empty()) {
    return report({"no opening is wide enough for a machine", arguments.plan});
  }
  const AliasOptions options;
  const AliasSurvey survey =
      AliasSurveyor(map, **index, *scanner, settings).survey(openings.places, threads, options);
  if (!arguments.output.empty()) {
    const auto drawn = draw(arguments.output, map, survey);
    if (!drawn) return report(drawn.error());
  }
  fmt::print("{}", alias_summary(survey, openings.pitch_m, options));
  if (!arguments.output.empty()) fmt::print("wrote {}\n", arguments.output);
  return kDone;
}

}  // namespace adit
