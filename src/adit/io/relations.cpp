#include "adit/io/relations.hpp"

#include <array>

#include "adit/io/text.hpp"

namespace adit {
namespace {

constexpr const char* kExpected = "expected t1 t2 x y z roll pitch yaw";

}  // namespace

Result<std::vector<PoseRelation>> parse_relations(std::string_view text, const std::string& file) {
  if (const auto checked = check_text(text, file); !checked) return tl::unexpected(checked.error());
  std::vector<PoseRelation> relations;
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    const std::string_view row = strip_comment(line);
    if (row.empty()) continue;
    std::array<double, 8> v{};
    if (const auto found = read_row(row, v))
      return fail(std::string(kExpected) + ", found " + *found, file, lines.number());
    relations.push_back({v[0], v[1], {v[2], v[3], wrap_angle(v[7])}});
  }
  if (relations.empty())
    return fail(std::string("no relation; ") + kExpected, file, lines.number());
  return relations;
}

Result<std::vector<PoseRelation>> read_relations(const std::string& path) {
  const auto text = read_text(path);
  if (!text) return tl::unexpected(text.error());
  return parse_relations(*text, path);
}

}  // namespace adit
