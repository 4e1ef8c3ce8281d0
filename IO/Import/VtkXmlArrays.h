// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/InputFile.h"

#include <cstdint>
#include <string_view>

namespace smg
{

/** Bytes that the arrays of an XML file of VTK take in memory, for each point and cell. */
struct VtkXmlArrays
{
  std::int64_t pointBytes = 0;
  std::int64_t cellBytes = 0;
};

/**
 * Adds up the arrays that `text`, the XML at the beginning of the file, announces; of several
 * pieces, the one with most counts.
 * @throws Error if an array has fewer than one or more than `most` components
 */
VtkXmlArrays vtkXmlArrays(const InputFile& file, std::string_view text, std::uint64_t most);

} // namespace smg
