// Trajectories, relations, estimates and JSON: the first byte chooses the reader.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "adit/io/estimates.hpp"
#include "adit/io/json.hpp"
#include "adit/io/relations.hpp"
#include "adit/io/trajectory.hpp"

namespace {

void read_estimates(std::string_view text) {
  const auto rows = adit::parse_estimates(text);
  if (rows && !adit::parse_estimates(adit::format_estimates(*rows))) std::abort();
}

void read_poses(std::string_view text) {
  const auto poses = adit::parse_trajectory(text);
  if (!poses) return;
  for (const adit::StampedPose& pose : *poses)
    if (!pose.pose.is_finite()) std::abort();
}

void read_json(std::string_view text) {
  const auto json = adit::parse_json(text);
  if (json && !adit::parse_json(json->to_text())) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0]) {
    case 'e':
      read_estimates(text);
      break;
    case 't':
      read_poses(text);
      break;
    case 'r':
      static_cast<void>(adit::parse_relations(text));
      break;
    default:
      read_json(text);
  }
  return 0;
}
