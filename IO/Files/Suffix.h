// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace smg
{

/** The suffix of a file's name with its dot, in lower case: ".vsm" of "MESH.VSM". */
inline std::string lowerSuffix(const std::filesystem::path& path)
{
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

} // namespace smg
