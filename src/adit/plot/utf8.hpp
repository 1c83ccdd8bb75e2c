#pragma once

#include <string>
#include <string_view>

namespace adit {

/// The text with everything that is no printable UTF-8 replaced by '?': one bad byte of a file's
/// name would make cairo refuse the whole picture.
std::string printable(std::string_view text);

}  // namespace adit
