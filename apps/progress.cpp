#include "progress.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace adit {

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), on_terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (on_terminal_ && shown_ >= 0) fmt::print(stderr, "\r{:60}\r", "");
}

void Progress::advance() {
  ++done_;
  if (!on_terminal_ || total_ == 0) return;
  const int percent = static_cast<int>(100 * done_ / total_);
  if (percent == shown_) return;
  shown_ = percent;
  const auto filled = static_cast<std::size_t>(percent / 4);
  fmt::print(stderr, "\r{} [{:<25}] {:3} %", what_, std::string(filled, '#'), percent);
}

}  // namespace adit
