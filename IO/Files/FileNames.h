// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <string_view>

namespace smg
{

/** `text` in quotes for error messages, shortened and with unprintable characters replaced. */
SMG_EXPORT std::string inQuotes(std::string_view text);

/** The suffix of a file's name with its dot, in lower case: ".vsm" of "MESH.VSM". */
inline std::string lowerSuffix(const std::filesystem::path& path)
{
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

} // namespace smg
