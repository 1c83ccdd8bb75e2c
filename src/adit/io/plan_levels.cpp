#include "adit/io/plan_levels.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <utility>

#include "adit/io/text.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

struct LevelFile {
  std::string name;
  std::string path;
};

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The name without the ending of a plan; empty for what is no plan's name.
std::string level_name(const std::string& file) {
  const std::string lower = lower_case(file);
  for (const std::string_view ending : {".vectormap.txt", ".txt", ".csv"}) {
    if (lower.ends_with(ending)) return file.substr(0, file.size() - ending.size());
  }
  return {};
}

Result<std::vector<LevelFile>> plan_files(const std::string& folder) {
  std::error_code code;
  std::vector<LevelFile> files;
  fs::directory_iterator entry(folder, code);
  for (; !code && entry != fs::directory_iterator(); entry.increment(code)) {
    std::error_code ignored;
    const std::string file = entry->path().filename().string();
    const std::string name = level_name(file);
    if (name.empty() || file.front() == '.' || !entry->is_regular_file(ignored)) continue;
    files.push_back({name, entry->path().string()});
  }
  if (code) return fail("cannot read the folder: " + code.message(), folder);
  std::sort(files.begin(), files.end(), [](const LevelFile& a, const LevelFile& b) {
    return std::pair(a.name, a.path) < std::pair(b.name, b.path);
  });
  return files;
}

}  // namespace

Result<std::vector<PlanLevel>> read_plan_levels(const std::string& path) {
  std::error_code ignored;
  std::vector<LevelFile> files{{"", path}};
  if (fs::is_directory(path, ignored)) {
    Result<std::vector<LevelFile>> found = plan_files(path);
    if (!found) return tl::unexpected(found.error());
    files = std::move(*found);
  }
  if (files.empty()) {
    return fail("the folder holds no plan; expected a .csv or .vectormap.txt file for each level",
                path);
  }
  std::vector<PlanLevel> levels;
  for (const LevelFile& file : files) {
    if (!levels.empty() && levels.back().name == file.name) {
      return fail("a level " + in_quotes(file.name) + " is there already", file.path);
    }
    Result<Plan> plan = read_plan(file.path);
    if (!plan) return tl::unexpected(plan.error());
    levels.push_back({file.name, std::move(*plan)});
  }
  return levels;
}

}  // namespace adit
