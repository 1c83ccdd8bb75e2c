#include <adit/map/line_map.hpp>
#include <array>
#include <cstdio>

int main() {
  const std::array<adit::Segment, 2> walls{{{{0.0, 0.0}, {4.0, 0.0}}, {{4.0, 0.0}, {4.0, 3.0}}}};
  const adit::LineMap map = adit::LineMap::build(walls);
  std::printf("%zu walls\n", map.walls().size());
  return map.walls().size() == 2 ? 0 : 1;
}
