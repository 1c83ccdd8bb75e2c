#include "adit/plot/atomic_write.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace adit {
namespace {

namespace fs = std::filesystem;

bool write_all(const std::string& path, std::string_view bytes) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  return out.good();
}

tl::unexpected<Error> cannot_write(const std::string& path, const std::string& why) {
  return fail("cannot write the picture: " + why, path);
}

}  // namespace

Result<void> write_picture_file(const std::string& path, std::string_view bytes) {
  std::error_code error;
  if (fs::is_directory(path, error)) return cannot_write(path, "it is a directory");
  // A link stays a link: its target is what changes.
  const fs::path real = fs::weakly_canonical(path, error);
  const std::string target = error ? path : real.string();
  const std::string part = target + ".part-" + std::to_string(::getpid());
  if (!write_all(part, bytes)) {
    const int why = errno;
    fs::remove(part, error);
    return cannot_write(path, why != 0 ? std::strerror(why) : "the disk may be full");
  }
  fs::rename(part, target, error);
  if (!error) return {};
  const std::string why = error.message();
  fs::remove(part, error);
  return cannot_write(path, why);
}

}  // namespace adit
