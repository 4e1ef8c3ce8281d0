// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/TextScanner.h"

#include <cstddef>
#include <cstdint>

namespace smg
{

/** The header of an OFF file. */
struct OffHeader
{
  std::int64_t vertices = 0, faces = 0;
  /** The values after the coordinates of a vertex, according to the keyword. */
  bool normals = false, colors = false, textureCoordinates = false;
  bool binary = false;
  std::size_t body = 0; ///< of a binary file: the byte at which its vertices begin
};

/** Reads a file up to its first vertex; a text with the scanner, which is at its beginning. Throws
 * Error if it is not an OFF file of points in space, or too short for its counts. */
OffHeader readOffHeader(InputFile& file, TextScanner& scanner);

} // namespace smg
