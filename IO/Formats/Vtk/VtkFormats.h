// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"
#include "smg/Column.h"
#include "smg/Export.h"

#include <string>
#include <string_view>

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

MeshFileFunction makeLegacyVtkWriter, makeVtkXmlWriter;
std::int64_t bytesOfVtk(const MeshToWrite& written);
std::int64_t bytesOfVtkXml(const MeshToWrite& written);

/** The names of the scalar types in VTK's XML files. */
inline constexpr std::string_view VtkXmlTypeNames[] = { "Int8", "UInt8", "Int16", "UInt16", "Int32",
  "UInt32", "Int64", "UInt64", "Float32", "Float64" };
constexpr std::string_view vtkXmlTypeName(ScalarType type)
{
  return VtkXmlTypeNames[static_cast<int>(type)];
}
/** The text with the characters that mean something in XML written as entities. */
SMG_EXPORT std::string xmlEscaped(const std::string& text);

} // namespace smg
