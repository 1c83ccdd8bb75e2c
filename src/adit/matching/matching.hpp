#pragma once

#include <span>
#include <vector>

#include "adit/features/features.hpp"

namespace adit {

/// When is a set of pairs consistent?
enum class Consistency {
  clique,  ///< every pair agrees with every other
  paper,   ///< each pair agrees with the two pairs before it in the (cyclic) order
};

/// The paper's tolerances under their names (section III-F; values of section IV-E).
struct MatchingOptions {
  Consistency consistency = Consistency::clique;
  double angerr = 0.0872664625997165;      // 5 degrees
  double poserr = 1.0;
  double concerr = 0.174532925199433;      // 10 degrees
  double disterr = 0.5;
  double terndisterr = 0.5;
  double ternangerr = 0.0872664625997165;  // 5 degrees
  int max_calls = 20000;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("angerr", self.angerr, "largest heading error of the predicted pose (rad)");
    field("poserr", self.poserr, "largest position error of the predicted pose (m)");
    field("concerr", self.concerr, "tolerance of a corner's concave angle (rad)");
    field("disterr", self.disterr, "tolerance of a line's perpendicular distance (m)");
    field("terndisterr", self.terndisterr, "tolerance of distances between pairs (m)");
    field("ternangerr", self.ternangerr, "tolerance of angles between pairs (rad)");
    field("max_calls", self.max_calls, "calls of the search after which the best set so far is taken");
  }
};

/// The largest consistent set found. `pairs` views the matcher's buffers.
struct MatchResult {
  std::span<const FeaturePair> pairs;
  int candidates = 0;    ///< pairs that passed the unary constraints
  int calls = 0;         ///< recursive calls of the search
  bool is_maximum = true;  ///< false when max_calls cut the search short
};

/// Feature matching (the paper, III-F). Keeps its buffers between calls.
class Matcher {
 public:
  /// Both lists in the frame of the predicted pose of the scanner: sensed features as extracted,
  /// model features transformed with the predicted pose.
  MatchResult match(const FeatureList& sensed, const FeatureList& model,
                    const MatchingOptions& options);
};

}  // namespace adit
