// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Convert.h"
#include "smg/Export.h"

#include <filesystem>
#include <optional>

namespace smg
{

/**
 * Converts a mesh file to a .vsm file that is kept and used again: it is made if it is not there,
 * and made anew if it was made by this function of the file of that path as it was before, or in
 * another order. The .vsm file says itself what it was made from (VsmFormat: origin).
 *
 * A file that is something else, also the conversion of a file elsewhere, is not touched, unless
 * `overwrite` is set. Processes that want the same conversion at the same time wait for the first
 * one and use its file.
 *
 * @return what the conversion did; none if `out` was up to date
 * @throws Error as convert(), and if `out` does not end in .vsm, is the input, or would be
 * overwritten without leave; Cancelled. A file that was there before is still there then.
 */
SMG_EXPORT std::optional<ConversionReport> convertToKeep(const std::filesystem::path& in,
  const std::filesystem::path& out, const ConversionOptions& options, bool overwrite = false);

} // namespace smg
