// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** STL, text or binary; corners with the same coordinates become one vertex. */
extern const Format StlFormat;

void importStl(InputFile& file, RawMeshBuilder& builder);
/**
 * Triangles with their corners' coordinates: binary if these are single precision numbers, else
 * text, which holds them exactly. There is no place for isolated vertices.
 */
WriteNotes writeRestoredStl(RestoredMesh& mesh, const std::filesystem::path& path);
std::int64_t bytesOfStl(const MeshToWrite& written);

} // namespace smg
