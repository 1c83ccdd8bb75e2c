// How accurate the localizer is, how honest about it, and what faults do to both: the statistical
// figures of docs/benchmarks.md, a command each. A wrong word makes it say which there are.
//
//   estimator_trials world=panel scanner=sick mode=single runs=20 seed=1000

#include <fmt/core.h>

#include <algorithm>

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
  int without_place = 0;  ///< seeds in which the fault found no place
  int clutter = 0;
};

/// Seed after seed, until there are the runs or the judged answers that the trial asks for.
Outcome run_all(const TrialOptions& options) {
  constexpr int kMostWithoutPlace = 100;
  Outcome outcome;
  std::int64_t judged = 0;
  const auto wants_more = [&] {
    if (outcome.without_place >= kMostWithoutPlace) return false;
    return options.answers > 0 ? judged < options.answers : outcome.runs < options.runs;
  };
  for (std::uint64_t seed = options.seed; wants_more(); ++seed) {
    const auto run = prepare_run(options, seed);
    if (!run) {
      ++outcome.without_place;
      continue;
    }
    localise(*run, options, seed, outcome.answers);
    ++outcome.runs;
    outcome.clutter += run->scene.clutter;
    judged += std::count(run->affected.begin(), run->affected.end(), true);
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
  if (outcome.answers.empty()) {
    fmt::print(stderr, "estimator_trials: this fault finds no place in this world\n");
    return 1;
  }
  fmt::print("{} runs, {} answers, {:.1f} pieces of clutter a run, {} seeds without place\n",
             outcome.runs, outcome.answers.size(),
             static_cast<double>(outcome.clutter) / outcome.runs, outcome.without_place);
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
