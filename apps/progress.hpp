#pragma once

#include <cstddef>
#include <string>

namespace adit {

/// A bar on a terminal, nothing in a pipe.
class Progress {
 public:
  Progress(std::string what, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance();

 private:
  std::string what_;
  std::size_t total_;
  std::size_t done_ = 0;
  int shown_ = -1;
  bool on_terminal_;
};

}  // namespace adit
