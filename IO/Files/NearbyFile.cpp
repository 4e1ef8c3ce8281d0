// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/NearbyFile.h"

#include <algorithm>
#include <system_error>

namespace smg
{

std::filesystem::path nearbyFile(
  const std::filesystem::path& folder, const std::filesystem::path& name)
{
  std::error_code error;
  const std::filesystem::path root = std::filesystem::canonical(folder / ".", error);
  const std::filesystem::path file =
    error ? std::filesystem::path{} : std::filesystem::weakly_canonical(root / name, error);
  if (error || name.is_absolute() ||
      std::mismatch(root.begin(), root.end(), file.begin(), file.end()).first != root.end())
  {
    return {};
  }
  return file;
}

} // namespace smg
