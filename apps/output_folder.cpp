#include "output_folder.hpp"

#include <filesystem>

namespace adit {

namespace fs = std::filesystem;

Result<void> write_all(const std::string& folder, const std::vector<OutputFile>& files) {
  std::error_code code;
  const bool made = fs::create_directories(folder, code);
  if (code) return fail("cannot make the folder: " + code.message(), folder);
  std::vector<std::string> written;
  for (const OutputFile& file : files) {
    const std::string path = (fs::path(folder) / file.name).string();
    Result<void> done = file.write(path);
    if (done) {
      written.push_back(path);
      continue;
    }
    for (const std::string& earlier : written) fs::remove(earlier, code);
    if (made) fs::remove(folder, code);
    return done;
  }
  return {};
}

}  // namespace adit
