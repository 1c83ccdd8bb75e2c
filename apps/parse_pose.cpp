#include "parse_pose.hpp"

#include <array>
#include <cmath>
#include <cstdlib>

namespace adit {

Result<Pose2> parse_pose(const std::string& text) {
  const auto wrong = [&] {
    return fail("'" + text + "' is no pose: expected x,y,heading in metres, metres, degrees");
  };
  std::array<double, 3> numbers{};
  const char* place = text.c_str();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && *place++ != ',') return wrong();
    char* end = nullptr;
    numbers[i] = std::strtod(place, &end);
    if (end == place || !std::isfinite(numbers[i])) return wrong();
    place = end;
  }
  if (*place != '\0') return wrong();
  return Pose2{numbers[0], numbers[1], wrap_angle(radians(numbers[2]))};
}

}  // namespace adit
