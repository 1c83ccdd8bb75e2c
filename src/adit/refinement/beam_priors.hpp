#pragma once

namespace adit {

/// What a beam may meet before anything is known of it: the map's wall, something else, or a wall
/// of the map behind one that is gone. One set for fits, the cycle and searches.
struct BeamPriors {
  double leave_ratio = 0.03;
  double back_ratio = 0.10;
  double long_ratio = 0.1;
  double gone_ratio = 0.005;
  double dropout_ratio = 0.05;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("leave_ratio", self.leave_ratio,
          "probability that the scan's next beam after one on a wall of the map meets something "
          "else");
    field("back_ratio", self.back_ratio,
          "probability that the next beam after one on something else, or through a wall that is "
          "gone, is back on the map's wall");
    field("long_ratio", self.long_ratio,
          "share of the beams that meet something else behind the map's wall, not before it");
    field("gone_ratio", self.gone_ratio,
          "probability that the next beam passes where the map has a wall that is gone (a door, a "
          "curtain, a cut), and meets the one beyond");
    field("dropout_ratio", self.dropout_ratio,
          "probability that a beam brings no return from a wall in reach; a search asks");
  }
};

}  // namespace adit
