#include "world_changes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string_view>

#include "adit/simulation/clutter.hpp"
#include "adit/simulation/ramps_on_way.hpp"
#include "adit/simulation/wall_clutter.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kMine = 1000000009;  // the mine and the way through it draw apart

struct Key {
  std::string_view name;
  double AsBuiltOptions::*value;
  double least;
  double most;
};

constexpr std::array<Key, 8> kKeys{{
    {"bend", &AsBuiltOptions::bend_m, 0.0, 10.0},
    {"reach", &AsBuiltOptions::reach_m, 1.0, 1e4},
    {"rough", &AsBuiltOptions::rough_m, 0.0, 10.0},
    {"missing", &AsBuiltOptions::missing_ratio, 0.0, 1.0},
    {"added", &AsBuiltOptions::added_ratio, 0.0, 1.0},
    {"chains", &AsBuiltOptions::chains_ratio, 0.0, 1.0},
    {"offset", &AsBuiltOptions::chain_offset_m, 0.0, 10.0},
    {"distortion", &AsBuiltOptions::distortion, 0.0, 0.1},
}};

Result<void> set_key(const std::string& pair, std::set<std::string_view>& given,
                     AsBuiltOptions& options) {
  const std::size_t equals = std::min(pair.find('='), pair.size());
  const std::string name = pair.substr(0, equals);
  const auto* const key =
      std::find_if(kKeys.begin(), kKeys.end(), [&](const Key& k) { return k.name == name; });
  if (key == kKeys.end()) {
    return fail("--as-built: no key '" + name +
                "': bend, reach, rough, missing, added, chains, offset, distortion");
  }
  if (!given.insert(key->name).second) return fail("--as-built: '" + name + "' is given twice");
  const std::string text = equals < pair.size() ? pair.substr(equals + 1) : "";
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= key->least && value <= key->most)) {
    return fail(fmt::format("--as-built: {}={} is no number from {:g} to {:g}", name, text,
                            key->least, key->most));
  }
  options.*(key->value) = value;
  return {};
}

void say_room(int placed, int asked, std::string_view what) {
  if (placed < asked) fmt::print(stderr, "adit: room for {} of {} {}\n", placed, asked, what);
}

}  // namespace

Result<AsBuiltOptions> parse_as_built(const std::string& text) {
  AsBuiltOptions options;
  std::set<std::string_view> given;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (const auto set = set_key(text.substr(begin, end - begin), given, options); !set) {
      return tl::unexpected(set.error());
    }
    begin = end + 1;
  }
  return options;
}

Result<double> change_world(const SimulateArguments& arguments, World& world) {
  double sigma = plan_error(world);
  if (arguments.as_built) {
    const auto options = parse_as_built(*arguments.as_built);
    if (!options) return tl::unexpected(options.error());
    world = as_built(std::move(world), *options, arguments.seed + kMine);
    // Rough walls are not an exact plan, even where nothing else is off.
    sigma = std::hypot(sigma, std::max(long_plan_error(*options), options->rough_m));
  }
  if (!arguments.off_plan.empty()) {
    const std::vector<double>& circle = arguments.off_plan;
    const bool is_finite = std::all_of(circle.begin(), circle.end(),
                                       [](double value) { return std::isfinite(value); });
    if (!is_finite || circle[2] <= 0.0) {
      return fail("--off-plan takes x,y,radius in metres, the radius above zero");
    }
    world = off_plan(std::move(world), {circle[0], circle[1]}, circle[2]);
    if (world.plan.empty()) return fail("--off-plan leaves nothing of the plan");
  }
  return sigma;
}

Result<void> furnish(const SimulateArguments& arguments, World& world) {
  if (arguments.clutter_kind == "free") {
    say_room(add_clutter(world, clutter_of(arguments.clutter), arguments.seed), arguments.clutter,
             "pieces of clutter");
  } else {
    const auto options = wall_clutter_named(arguments.clutter_kind, arguments.clutter);
    if (!options) return fail("no clutter '" + arguments.clutter_kind + "'");
    say_room(add_wall_clutter(world, *options, arguments.seed), arguments.clutter,
             "pieces of clutter");
  }
  say_room(lay_ramps(world, arguments.ramps, arguments.seed), arguments.ramps, "ramps");
  return {};
}

}  // namespace adit
