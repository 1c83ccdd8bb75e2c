// How accurate the localizer is, and how honest about it: the statistical
// figures of docs/benchmarks.md, a command each. A wrong word makes it say which there are.
//
//   estimator_trials world=panel scanner=sick mode=single runs=20 seed=1000

#include <fmt/core.h>

#include <iterator>

#include "trial_consistency.hpp"
#include "trial_figures.hpp"
#include "trial_options.hpp"
#include "trial_run.hpp"
#include "trial_sweep.hpp"

namespace adit {
namespace {

struct Outcome {
  std::vector<Answer> answers;
  int runs = 0;
  int clutter = 0;
};

/// Seed after seed, until there are the runs or the answers that the trial asks for.
Outcome run_all(const TrialOptions& options) {
  Outcome outcome;
  const auto wants_more = [&] {
    return options.answers > 0 ? std::ssize(outcome.answers) < options.answers
                               : outcome.runs < options.runs;
  };
  for (std::uint64_t seed = options.seed; wants_more(); ++seed) {
    const TrialRun run = plain_run(make_scene(options, seed), seed);
    localise(run, options, seed, outcome.answers);
    ++outcome.runs;
    outcome.clutter += run.scene.clutter;
  }
  return outcome;
}

/// Whether the walls stand exactly where the plan says.
bool is_exact(TrialWorld world) {
  return world == TrialWorld::mockup || world == TrialWorld::stress;
}

bool compares_motion(TrialWorld world) {
  return world == TrialWorld::sweep || world == TrialWorld::sweep_panel;
}

int trial(const TrialOptions& options) {
  fmt::print("estimator_trials {}\n", to_text(options));
  if (compares_motion(options.world)) {
    fmt::print("{}", sweep_trial(options));
    return 0;
  }
  const Outcome outcome = run_all(options);
  fmt::print("{} runs, {} answers, {:.1f} pieces of clutter a run\n", outcome.runs,
             outcome.answers.size(), static_cast<double>(outcome.clutter) / outcome.runs);
  if (is_exact(options.world)) {
    const TrialScene scene = make_scene(options, options.seed);
    fmt::print("{}", bound_text(outcome.answers, LineMap::build(scene.world.plan), scene.scanner));
  }
  fmt::print("{}{}{}{}{}{}", accuracy_text(outcome.answers), status_text(outcome.answers),
             consistency_text(outcome.answers), protection_text(outcome.answers),
             time_text(outcome.answers), worst_text(outcome.answers, options.worst));
  return 0;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  const auto options = adit::parse_trial({argv + 1, argv + argc});
  if (!options) {
    fmt::print(stderr, "estimator_trials: {}\n{}", options.error().message, adit::trial_usage());
    return 2;
  }
  return adit::trial(*options);
}
