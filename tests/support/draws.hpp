#pragma once

#include <Eigen/Core>

namespace adit::test {

/// A vector of what `draw` gives, the last component first. A call's arguments are evaluated in an
/// order that each compiler chooses, so `Vector2d(draw(), draw())` is not the same with all.
template <int kSize, typename Draw>
Eigen::Matrix<double, kSize, 1> drawn(Draw&& draw) {
  Eigen::Matrix<double, kSize, 1> vector;
  for (int i = kSize - 1; i >= 0; --i) vector(i) = draw();
  return vector;
}

}  // namespace adit::test
