#include "adit/config/configuration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "adit/config/fields.hpp"
#include "adit/config/toml.hpp"
#include "adit/io/atomic_file.hpp"
#include "adit/io/text.hpp"

namespace adit {
namespace {

/// How many single letters must change to make one word of the other (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replace});
    }
  }
  return row.back();
}

/// The three names nearest to a word, nearest first.
std::string nearest(std::string_view word, std::vector<std::string> names) {
  word = word.substr(0, 64);
  std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < 3; ++i) text += (i > 0 ? ", " : "") + names[i];
  return text;
}

std::string unknown_table(std::string_view table) {
  std::vector<std::string> names;
  for (const ConfigTable& known : config_tables()) names.push_back(known.name);
  return "unknown table " + in_quotes(table) + "; nearest known: " + nearest(table, names);
}

std::string unknown_key(const TomlEntry& entry, const std::vector<ConfigField>& fields) {
  std::vector<std::string> names;
  for (const ConfigField& field : fields) {
    if (entry.table.empty()) names.push_back("[" + field.table + "] " + field.key);
    if (field.table == entry.table) names.push_back(field.key);
  }
  const std::string where = entry.table.empty() ? " outside a table" : " in [" + entry.table + "]";
  return "unknown key " + in_quotes(entry.key) + where +
         "; nearest known: " + nearest(entry.key, names);
}

std::optional<double> number_of(const TomlValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  return std::nullopt;
}

/// Lengths, angles and thresholds that something is divided by, or that mean nothing at 0.
constexpr std::array kAboveZero = {
    "map.length_m",
    "map.prior_metres",
    "map.memory_metres",
    "motion.speed_sigma_m_per_s",
    "motion.turn_rate_sigma_rad_per_s",
    "extraction.min_operator_m",
    "extraction.max_operator_m",
    "extraction.corner_chi_square",
    "extraction.min_corner_turn_rad",
    "extraction.grazing_rad",
    "belief.map_stretch_m",
    "refinement.max_step_m",
    "refinement.max_step_rad",
    "refinement.station_spacing_m",
    "search.least_reach_m",
    "search.least_reach_rad",
    "tracking.bias_distance_m",
    "tracking.gate_chi_square",
    "protection.loose_prior",
    "localizer.start_sigma_m",
    "localizer.start_sigma_rad",
    "localizer.prior_floor_m",
    "localizer.prior_floor_rad",
    "localizer.prior_inflation",
    "survey_alignment.scale_m",
    "survey_alignment.wall_sigma_m",
    "survey_alignment.shared_error_points",
    "survey_loops.cell_m",
    "survey_loops.blur_m",
    "survey_loops.first_limit_m",
    "survey_loops.closure_sigma_m",
    "survey_loops.closure_sigma_rad",
    "survey_joint.sight_m",
    "survey_joint.anchor_sigma_m",
    "survey_joint.anchor_sigma_rad",
    "survey_joint.pair_sigma_m",
    "survey_joint.pair_sigma_rad",
    "survey_known_places.apart_m",
    "survey_known_places.plan_sigma_m",
    "survey_changes.step_m",
    "survey_positions.given_within_rad",
    "survey_positions.coarse_step_rad",
    "survey_positions.point_spacing_m",
    "survey_positions.coarse_blur_m",
    "survey_positions.fine_blur_m",
    "survey_positions.wall_error_m",
    "hypotheses.independent_way_m",
    "places.pitch_m",
    "places.finest_pitch_m",
    "places.enough_places",
    "places.most_places",
    "relocation.corner_sigma_m",
    "relocation.corner_cell_m",
    "relocation.corner_cell_rad",
    "relocation.start_m",
    "relocation.doubt_rad",
    "relocation.basin_m",
    "relocation.basin_rad",
    "relocation.least_map_ratio",
    "survey_walls.visit_m",
    "survey_walls.cell_m",
    "survey_walls.merge_m",
    "survey_walls.smooth_m",
    "survey_walls.tolerance_m",
};

/// Probabilities of what may or may not happen.
constexpr std::array kProbabilities = {
    "beams.leave_ratio", "beams.back_ratio",    "beams.long_ratio",
    "beams.gone_ratio",  "beams.dropout_ratio", "protection.risk",
};

/// Counts that cannot be 0, and the least that they can be.
constexpr std::array<std::pair<const char*, int>, 13> kLeastCounts = {{
    {"refinement.max_iterations", 1},
    {"extraction.min_line_points", 3},
    {"matching.max_candidates", 1},
    {"matching.max_calls", 1},
    {"estimation.max_iterations", 1},
    {"survey_surfaces.most_points", 30},
    {"survey_alignment.max_iterations", 1},
    {"survey_tracking.local_keyframes", 1},
    {"survey_joint.rounds", 1},
    {"survey_loops.query_keyframes", 1},
    {"survey_loops.target_keyframes", 1},
    {"survey_loops.query_stride", 1},
    {"survey_loops.target_stride", 1},
}};

/// What a number may be, and how to say so.
struct Bounds {
  bool above_zero = false;
  bool below_one = false;

  bool hold(double value) const {
    if (!std::isfinite(value) || value < 0.0) return false;
    return !(above_zero && value == 0.0) && !(below_one && value >= 1.0);
  }
  const char* words() const {
    if (below_one) return "a number above 0 and below 1";
    return above_zero ? "a finite number above 0" : "a finite number, 0 or more";
  }
};

Bounds bounds_of(const std::string& name) {
  const auto lists = [&](const auto& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const bool is_probability = lists(kProbabilities);
  return {is_probability || lists(kAboveZero), is_probability};
}

int least_count(const std::string& name) {
  for (const auto& [key, least] : kLeastCounts)
    if (key == name) return least;
  return 0;
}

/// Sets the field, or says what was expected.
std::optional<std::string> set(const ConfigField& field, const TomlValue& value) {
  if (auto* const* target = std::get_if<double*>(&field.target)) {
    const auto number = number_of(value);
    const Bounds bounds = bounds_of(field.name());
    if (!number || !bounds.hold(*number)) return bounds.words();
    **target = *number;
    return std::nullopt;
  }
  if (auto* const* target = std::get_if<int*>(&field.target)) {
    const auto* number = std::get_if<std::int64_t>(&value);
    const int least = least_count(field.name());
    if (number == nullptr || *number < least || *number > std::numeric_limits<int>::max())
      return "a whole number, " + std::to_string(least) + " or more";
    **target = static_cast<int>(*number);
    return std::nullopt;
  }
  if (auto* const* target = std::get_if<bool*>(&field.target)) {
    const auto* flag = std::get_if<bool>(&value);
    if (flag == nullptr) return "true or false";
    **target = *flag;
    return std::nullopt;
  }
  const auto& words = std::get<WordField>(field.target);
  const auto* word = std::get_if<std::string>(&value);
  if (word != nullptr &&
      std::find(words.words.begin(), words.words.end(), *word) != words.words.end()) {
    words.set(*word);
    return std::nullopt;
  }
  std::string expected;
  for (const std::string& known : words.words)
    expected += (expected.empty() ? "\"" : " or \"") + known + "\"";
  return expected;
}

/// What no single key shows to be wrong.
Result<void> check_together(const Configuration& c, const std::vector<TomlEntry>& entries,
                            const std::string& file) {
  if (c.localizer.scanner.max_range_m > c.localizer.scanner.min_range_m) return {};
  const auto is_bound = [](const TomlEntry& e) {
    return e.table == "scanner" && (e.key == "max_range_m" || e.key == "min_range_m");
  };
  const auto at = std::find_if(entries.rbegin(), entries.rend(), is_bound);
  return fail("expected scanner.max_range_m above scanner.min_range_m", file,
              at == entries.rend() ? 0 : at->line);
}

bool is_chosen(const ConfigField& field, const std::set<std::string>& only) {
  return only.empty() || only.contains(field.table) || only.contains(field.name());
}

}  // namespace

Result<LoadedConfiguration> parse_configuration(std::string_view text, const std::string& file,
                                                const Configuration& base) {
  if (const auto checked = check_text(text, file); !text.empty() && !checked)
    return tl::unexpected(checked.error());
  LoadedConfiguration out{base, {}};
  const auto entries = parse_toml(text, file);
  if (!entries) return tl::unexpected(entries.error());
  const std::vector<ConfigField> fields = fields_of(out.values);
  const std::vector<ConfigTable> tables = config_tables();
  for (const TomlEntry& entry : *entries) {
    const bool known_table = std::any_of(
        tables.begin(), tables.end(), [&](const ConfigTable& t) { return t.name == entry.table; });
    if (!known_table && !entry.table.empty())
      return fail(unknown_table(entry.table), file, entry.line);
    if (known_table && entry.key.empty() && std::holds_alternative<std::monostate>(entry.value))
      continue;
    const auto field = std::find_if(fields.begin(), fields.end(), [&](const ConfigField& f) {
      return f.table == entry.table && f.key == entry.key;
    });
    if (field == fields.end()) return fail(unknown_key(entry, fields), file, entry.line);
    if (const auto expected = set(*field, entry.value))
      return fail(field->name() + ": expected " + *expected, file, entry.line);
    out.given.insert(field->name());
  }
  if (const auto checked = check_together(out.values, *entries, file); !checked)
    return tl::unexpected(checked.error());
  return out;
}

Result<LoadedConfiguration> read_configuration(const std::string& path, const Configuration& base) {
  const auto text = read_text(path);
  if (!text) return tl::unexpected(text.error());
  return parse_configuration(*text, path, base);
}

std::string format_configuration(const Configuration& configuration,
                                 const std::set<std::string>& only) {
  Configuration copy = configuration;
  const std::vector<ConfigField> fields = fields_of(copy);
  std::string text;
  for (const ConfigTable& table : config_tables()) {
    std::string body;
    for (const ConfigField& field : fields) {
      if (field.table != table.name || !is_chosen(field, only)) continue;
      body += "# " + field.documentation + "\n" + field.key + " = " + value_text(field) + "\n";
    }
    if (body.empty()) continue;
    if (!text.empty()) text += "\n";
    text += "# " + table.documentation + "\n[" + table.name + "]\n" + body;
  }
  return text;
}

Result<void> write_configuration(const Configuration& configuration, const std::string& path,
                                 const std::set<std::string>& only) {
  return write_file(path, format_configuration(configuration, only));
}

std::string configuration_reference() {
  Configuration defaults;
  const std::vector<ConfigField> fields = fields_of(defaults);
  std::string text =
      "# Configuration\n\nOne TOML file, given with `--config`. Every key may be left out: the "
      "default holds, or what the log\nitself tells. Unknown keys are errors. SI units and "
      "radians; "
      "sigmas are one sigma.\n";
  for (const ConfigTable& table : config_tables()) {
    text += "\n## [" + table.name + "]\n\n" + table.documentation +
            "\n\n| key | default | meaning |\n|---|---|---|\n";
    for (const ConfigField& field : fields) {
      if (field.table != table.name) continue;
      text += "| `" + field.key + "` | `" + value_text(field) + "` | " + field.documentation;
      if (const auto* words = std::get_if<WordField>(&field.target)) {
        text += ":";
        for (const std::string& word : words->words) text += " `" + word + "`";
      }
      text += " |\n";
    }
  }
  return text;
}

}  // namespace adit
