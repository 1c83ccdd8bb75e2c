#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adit/geometry/result.hpp"

namespace adit {

/// A file to be, and what writes it to the path it is given.
struct OutputFile {
  std::string name;
  std::function<Result<void>(const std::string& path)> write;
};

/// Writes all files into a folder, which is made if need be; after a failure none of them is left
/// there, nor the folder if it was made here.
Result<void> write_all(const std::string& folder, const std::vector<OutputFile>& files);

}  // namespace adit
