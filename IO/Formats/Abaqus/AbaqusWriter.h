// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/MeshFileWriter.h"
#include "IO/Mesh/Format.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace smg
{

/** Writes triangles (S3), quadrilaterals (S4) or tetrahedra (C3D4), with the groups as sets and
 * surfaces. */
MeshFileFunction makeAbaqusWriter;

std::int64_t bytesOfAbaqus(const MeshToWrite& written);

} // namespace smg
