// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Smooth.h"

#include <optional>
#include <string>

namespace smg
{

/**
 * The bytes of a size with a unit, as 512M, 1.5GiB or 2GB, at least 1 MiB. K, M, G and T are powers
 * of 1024, and so with iB; KB, MB, GB and TB powers of 1000. None for a text that is no number, or
 * one without a unit. Throws Error, which quotes the text, if the unit is another one or the size
 * is too small.
 */
SMG_EXPORT std::optional<double> bytesOf(const std::string& text);

/** The size of details of a text, above 0: a number in the unit of the mesh, or followed by % of
 * the diagonal of its bounds or by edges, as 6edges. None if it is not one. */
SMG_EXPORT std::optional<SmoothingSize> smoothingSizeOf(const std::string& text);

} // namespace smg
