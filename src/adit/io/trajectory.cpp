#include "adit/io/trajectory.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

#include "adit/io/atomic_file.hpp"
#include "adit/io/text.hpp"

namespace adit {
namespace {

constexpr const char* kExpected = "expected t x y z qx qy qz qw";

}  // namespace

Result<std::vector<StampedPose>> parse_trajectory(std::string_view text, const std::string& file) {
  if (const auto checked = check_text(text, file); !checked) return tl::unexpected(checked.error());
  std::vector<StampedPose> poses;
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    const std::string_view row = strip_comment(line);
    if (row.empty()) continue;
    std::array<double, 8> v{};
    if (const auto found = read_row(row, v))
      return fail(std::string(kExpected) + ", found " + *found, file, lines.number());
    const auto [t, x, y, z, qx, qy, qz, qw] = v;
    if (!(std::abs(std::hypot(std::hypot(qx, qy), std::hypot(qz, qw)) - 1.0) < 0.05))
      return fail(std::string(kExpected) + ", found a quaternion that is not of length 1", file,
                  lines.number());
    const double yaw = std::atan2(2.0 * (qw * qz + qx * qy), qw * qw + qx * qx - qy * qy - qz * qz);
    poses.push_back({t, {x, y, wrap_angle(yaw)}});
  }
  if (poses.empty()) return fail(std::string("no pose; ") + kExpected, file, lines.number());
  return poses;
}

Result<std::vector<StampedPose>> read_trajectory(const std::string& path) {
  const auto text = read_text(path);
  if (!text) return tl::unexpected(text.error());
  return parse_trajectory(*text, path);
}

Result<void> write_trajectory(std::span<const StampedPose> poses, const std::string& path) {
  std::string text;
  for (const auto& [stamp, pose] : poses) {
    if (!pose.is_finite() || !std::isfinite(stamp)) return fail("a pose that is not finite", path);
    fmt::format_to(std::back_inserter(text),
                   FMT_COMPILE("{:.6f} {:.9f} {:.9f} 0 0 0 {:.9f} {:.9f}\n"), stamp, pose.x, pose.y,
                   std::sin(0.5 * pose.theta), std::cos(0.5 * pose.theta));
  }
  return write_file(path, text);
}

}  // namespace adit
