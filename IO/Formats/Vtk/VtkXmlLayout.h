// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Formats/Vtk/ByteSource.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Formats/Vtk/XmlTags.h"

#include <cstdint>

namespace smg
{

/**
 * Finds out where everything stands in a .vtp or .vtu file and adds its pieces to the layout.
 * Arrays of texts and bits are left out.
 * @param maxBytes of memory that the layout may take
 * @throws Error with the byte where the file is wrong or ends too early, or has another kind of
 * data
 */
void addVtkXmlLayout(InputFile& file, VtkLayout& layout, std::int64_t maxBytes);

/** How a file stores its arrays that are not text, as its root element declares. */
struct VtkXmlEncoding
{
  std::endian byteOrder = std::endian::little;
  int headerBytes = 4;
  VtkCompression compression = VtkCompression::None;
};

/** Throws Error if the compressor is not known. */
VtkXmlEncoding vtkXmlEncoding(const InputFile& file, const XmlTag& root);

/**
 * The array of a tag <DataArray>; how many values it has is not known yet. One that is appended has
 * the encoding Raw, and its begin is an offset from the first byte of the appended data. Throws
 * Error.
 */
VtkArray vtkXmlArray(
  const InputFile& file, const XmlTag& tag, ScalarType type, const VtkXmlEncoding& encoding);

/** The value of an attribute as a count; 0 if it is missing. Throws Error if it is not a count. */
std::int64_t vtkXmlCount(const InputFile& file, const XmlTag& tag, const char* name);

/**
 * The tag <VTKFile>, which comes first. Throws Error if it does not, or if the file does not end
 * with its closing tag.
 */
XmlTag vtkXmlRoot(InputFile& file, XmlTags& tags);

} // namespace smg
