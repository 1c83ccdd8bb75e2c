#pragma once

#include <span>
#include <string>
#include <vector>

#include "adit/localizer/settings.hpp"
#include "adit/plot/place_figures.hpp"
#include "adit/relocation/relocator.hpp"
#include "adit/simulation/scanner.hpp"

namespace adit {

/// What counts as another pose that looks the same.
struct AliasOptions {
  double least_weight = 0.01;
  double open_chi_square = 16.3;
  std::size_t worst_pairs = 10;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("least_weight", self.least_weight, "a pose of less weight is no alias");
    field(
        "open_chi_square", self.open_chi_square,
        "an answer that leaves a direction open is right within this; chi-square of three degrees "
        "of freedom at 1e-3");
    field("worst_pairs", self.worst_pairs, "so many pairs that look the same are named");
  }
};

/// Two poses from which the scan of the first looks the same.
struct Alias {
  Pose2 pose;
  Pose2 other;
  double weight = 0.0;  ///< of the other among all that explain the scan
};

/// How the scans of a plan's places are answered: one entry for each, in their order.
struct AliasSurvey {
  std::vector<SurveyedPlace> places;
  std::vector<Alias> aliases;
};

/// Takes a scan without noise at each place, looking along the farthest view, and looks for it in
/// the whole plan, as if the scanner had its noise and the plan its error.
class AliasSurveyor {
 public:
  AliasSurveyor(const LineMap& map, const PlaceIndex& index, const ScannerSpec& scanner,
                const LocalizerSettings& settings);

  AliasSurvey survey(std::span<const Vector2d> places, int threads,
                     const AliasOptions& options) const;

 private:
  Pose2 pose_at(const Vector2d& place) const;
  SurveyedPlace judge(const Pose2& truth, const RelocationResult& found,
                      const AliasOptions& options, std::vector<Alias>& aliases) const;

  const LineMap& map_;
  const PlaceIndex& index_;
  ScannerSpec scanner_;
  const LocalizerSettings& settings_;
  RayCaster caster_;
};

/// Shares and the worst pairs, for the terminal.
std::string alias_summary(const AliasSurvey& survey, double pitch_m, const AliasOptions& options);

}  // namespace adit
