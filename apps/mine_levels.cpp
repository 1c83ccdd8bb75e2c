#include "mine_levels.hpp"

#include <fmt/core.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

#include "adit/io/atomic_file.hpp"
#include "adit/places/place_file.hpp"

namespace adit {

namespace {

std::string file_of(const IndexSettings& settings, const std::string& level) {
  return settings.file.empty() || level.empty() ? settings.file : settings.file + "." + level;
}

/// None where there is no such file yet, or one of another plan.
Result<std::optional<PlaceIndex>> read_index(const std::string& file, const LineMap& map,
                                             const PlaceIndexOptions& options) {
  std::error_code unknown;
  if (file.empty() || !std::filesystem::exists(file, unknown)) return std::optional<PlaceIndex>();
  std::ifstream in(file, std::ios::binary);
  if (!in) return fail("cannot be read", file);
  auto read = read_places(map, options, in);
  if (!read) return fail(read.error().message, file);
  if (!*read) {
    fmt::print(stderr, "adit: {}: of another plan, other options or another version, made anew\n",
               file);
  }
  return read;
}

Result<void> write_index(const std::string& file, const PlaceIndex& index, const LineMap& map,
                         const PlaceIndexOptions& options) {
  std::ostringstream out;
  if (const auto written = write_places(index, map, options, out); !written) {
    return fail(written.error().message, file);
  }
  return write_file(file, std::move(out).str());
}

/// What an index holds, in words.
std::string contents_of(const PlaceIndex& index) {
  const std::string corners = fmt::format("{} corners", index.corners().size());
  if (index.empty()) return "no places, and " + corners;
  return fmt::format("{} places, {:.2f} m apart, and {}", index.size(), index.pitch_m(), corners);
}

}  // namespace

Result<std::shared_ptr<const PlaceIndex>> index_of(const LineMap& map,
                                                   const IndexSettings& settings,
                                                   const std::string& level) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const std::string file = file_of(settings, level);
  auto read = read_index(file, map, settings.places);
  if (!read) return tl::unexpected(read.error());
  const bool is_read = read->has_value();
  auto index = std::make_shared<const PlaceIndex>(
      is_read ? std::move(**read) : PlaceIndex::build(map, settings.places, settings.threads));
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  fmt::print(stderr, "adit: {}index of {}, {:.1f} MB, {} in {:.2f} s\n",
             level.empty() ? "" : "level " + level + ": ", contents_of(*index),
             1e-6 * static_cast<double>(index->memory()), is_read ? "read" : "built", seconds);
  if (!file.empty() && !is_read) {
    const auto written = write_index(file, *index, map, settings.places);
    if (!written) return tl::unexpected(written.error());
  }
  return index;
}

Result<std::vector<MineLevel>> prepare_levels(const std::vector<PlanLevel>& plans,
                                              const LineMapOptions& cleaning,
                                              const IndexSettings& settings) {
  std::vector<MineLevel> levels;
  for (const PlanLevel& plan : plans) {
    MineLevel level{plan.name, LineMap::build(plan.plan.segments, cleaning), nullptr};
    auto places = index_of(level.map, settings, level.name);
    if (!places) return tl::unexpected(places.error());
    level.places = std::move(*places);
    levels.push_back(std::move(level));
  }
  return levels;
}

std::string names_of(const std::vector<PlanLevel>& plans) {
  std::string text;
  for (const PlanLevel& plan : plans) text += (text.empty() ? "" : ", ") + plan.name;
  return text;
}

}  // namespace adit
