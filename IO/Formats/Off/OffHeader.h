// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/TextScanner.h"

#include <cstddef>
#include <cstdint>

namespace smg
{

/** What an OFF file says of itself at its beginning. */
struct OffHeader
{
  std::int64_t vertices = 0, faces = 0;
  /** What its keyword says to stand behind the coordinates of a vertex. */
  bool normals = false, colors = false, textureCoordinates = false;
  bool binary = false;
  std::size_t body = 0; ///< of a binary file: the byte at which its vertices begin
};

/** Reads a file up to its first vertex: a text by the scanner, which is at its beginning. Throws
 * Error if it is no OFF file of points in space, or too short for its counts. */
OffHeader readOffHeader(InputFile& file, TextScanner& scanner);

} // namespace smg
