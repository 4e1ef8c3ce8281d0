// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "CommonOptions.h"

#include "smg/VsmReader.h"

#include <cstdint>
#include <filesystem>
#include <functional>

/** Memory to draw a mesh with, unless --memory says otherwise. */
inline constexpr std::int64_t DrawingMemory = std::int64_t(256) << 20;

/** What `draw` returns, for a report as a page. The command has done its work, so that an error is
 * told there, in place of the surface. A cancellation says on standard error that the file
 * `written` is complete, unless it is empty. */
html::ResultSurface drawnBy(
  const std::filesystem::path& written, const std::function<html::ResultSurface()>& draw);

/** The surface of a mesh, likewise. */
html::ResultSurface surfaceOf(const smg::VsmReader& mesh, const CommonOptions& common);
/** The same of the mesh that a command has written, in any format. */
html::ResultSurface surfaceOf(const std::filesystem::path& written, const CommonOptions& common);
