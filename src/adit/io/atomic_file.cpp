#include "adit/io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace adit {
namespace {

namespace fs = std::filesystem;

/// 0, or the error number.
int write_all(int descriptor, std::string_view contents) {
  while (!contents.empty()) {
    const ssize_t written = ::write(descriptor, contents.data(), contents.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int write_and_close(int descriptor, std::string_view contents) {
  const int status = write_all(descriptor, contents);
  const int closed = ::close(descriptor) == 0 ? 0 : errno;
  return status != 0 ? status : closed;
}

tl::unexpected<Error> cannot_write(const std::string& path, int error_number) {
  return fail(std::string("cannot write: ") + std::strerror(error_number), path);
}

Result<void> write_special(const std::string& path, std::string_view contents) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return cannot_write(path, errno);
  if (const int status = write_and_close(descriptor, contents)) return cannot_write(path, status);
  return {};
}

/// Creates a file beside the target, so that the rename stays within one file system. Returns its
/// descriptor or -1 with errno.
int create_neighbour(const std::string& target, std::string& name) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    name = target + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
  return -1;
}

}  // namespace

Result<void> write_file(const std::string& path, std::string_view contents) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) return cannot_write(path, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_special(path, contents);

  std::string target = path;
  if (fs::exists(status)) {
    if (::access(path.c_str(), W_OK) != 0) return cannot_write(path, errno);
    if (const fs::path real = fs::canonical(path, error); !error) target = real.string();
  }
  std::string part;
  const int descriptor = create_neighbour(target, part);
  if (descriptor < 0) return cannot_write(path, errno);
  int failure = 0;
  if (fs::exists(status)) {
    const auto mode = static_cast<mode_t>(status.permissions() & fs::perms::mask);
    if (::fchmod(descriptor, mode) != 0) failure = errno;
  }
  const int written = write_and_close(descriptor, contents);
  if (failure == 0) failure = written;
  if (failure == 0 && ::rename(part.c_str(), target.c_str()) != 0) failure = errno;
  if (failure == 0) return {};
  ::unlink(part.c_str());
  return cannot_write(path, failure);
}

}  // namespace adit
