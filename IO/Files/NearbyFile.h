// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <filesystem>

namespace smg
{

/**
 * The file to which a mesh file in `folder` refers as `name`, if it is in this folder or below,
 * also after following links; else empty. A mesh file from elsewhere must not make a program read
 * other files of its user.
 */
SMG_EXPORT std::filesystem::path nearbyFile(
  const std::filesystem::path& folder, const std::filesystem::path& name);

} // namespace smg
