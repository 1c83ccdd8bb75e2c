#include "adit/simulation/drive_line.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

// Each round of averaging adds half a squared step to the kernel's variance: at 0.4 m, 1.8 m.
constexpr int kRounds = 40;

std::vector<Vector2d> densified(const std::vector<Vector2d>& line, double step) {
  std::vector<Vector2d> dense = {line.front()};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vector2d along = line[i] - line[i - 1];
    const int pieces = std::max(1, static_cast<int>(std::ceil(along.norm() / step)));
    for (int k = 1; k <= pieces; ++k) {
      dense.push_back(line[i - 1] + along * (static_cast<double>(k) / pieces));
    }
  }
  return dense;
}

/// Draws each point towards the middle of its neighbours where that leaves both pieces clear.
void relax(const DriveMap& map, std::vector<Vector2d>& line) {
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      const Vector2d middle = 0.5 * (line[i - 1] + line[i + 1]);
      const Vector2d to = 0.5 * (line[i] + middle);
      if (map.is_clear(line[i - 1], to) && map.is_clear(to, line[i + 1])) line[i] = to;
    }
  }
}

/// Points a step apart on the line; where the straight way to the next is not clear, the line's own
/// points on the way to it stay.
std::vector<Vector2d> paced(const DriveMap& map, const std::vector<Vector2d>& line, double step) {
  std::vector<Vector2d> out = {line.front()};
  std::size_t next = 1;
  while (next < line.size()) {
    const Vector2d& from = out.back();
    std::size_t beyond = next;
    while (beyond < line.size() && (line[beyond] - from).norm() < step) ++beyond;
    Vector2d to = line.back();
    if (beyond < line.size()) {
      // Where the piece that leads out of the circle of one step crosses it.
      const Vector2d& inner = beyond > next ? line[beyond - 1] : from;
      const Vector2d along = line[beyond] - inner;
      const Vector2d off = inner - from;
      const double a = along.squaredNorm();
      const double b = off.dot(along);
      const double c = off.squaredNorm() - step * step;
      to = inner + along * std::clamp((std::sqrt(std::max(0.0, b * b - a * c)) - b) / a, 0.0, 1.0);
    }
    if (beyond > next && !map.is_clear(from, to)) {
      to = line[next];
      beyond = next + 1;
    }
    next = beyond;
    out.push_back(to);
  }
  return out;
}

}  // namespace

std::vector<Vector2d> smoothed(const DriveMap& map, const std::vector<Vector2d>& line,
                               double step_m) {
  if (line.size() < 2) return line;
  std::vector<Vector2d> dense = densified(line, step_m);
  relax(map, dense);
  return paced(map, dense, step_m);
}

}  // namespace adit
