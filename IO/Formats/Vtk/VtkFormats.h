// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"

namespace smg
{

/** Legacy VTK, text and binary, polygonal data and unstructured grids, layouts 2.0 to 5.1. */
extern const Format LegacyVtkFormat;
/**
 * VTK XML (.vtp, .vtu): appended and inline data, as text, base64 or raw, plain or compressed by
 * zlib, LZ4 or LZMA.
 */
extern const Format VtkXmlFormat;
/** The pieces of a .pvtp or .pvtu file, one after the other. */
SMG_EXPORT extern const Format ParallelVtkXmlFormat;

void importLegacyVtk(InputFile& file, RawMeshBuilder& builder);
void importVtkXml(InputFile& file, RawMeshBuilder& builder);
void importParallelVtkXml(
  InputFile& file, RawMeshBuilder& builder, const ProgressFunction& progress);

/** Legacy VTK, binary, version 3.0, which is widely supported: polygonal data, or an unstructured
 * grid of tetrahedra, with all columns as field data. Corners are 32-bit numbers. */
WriteNotes writeRestoredVtk(RestoredMesh& mesh, const std::filesystem::path& path);
std::int64_t bytesOfVtk(const MeshToWrite& written);
/** .vtp (polygons) or .vtu (triangles, quadrilaterals, polygons or tetrahedra), with all columns.
 */
WriteNotes writeRestoredVtkXml(RestoredMesh& mesh, const std::filesystem::path& path);
std::int64_t bytesOfVtkXml(const MeshToWrite& written);

} // namespace smg
