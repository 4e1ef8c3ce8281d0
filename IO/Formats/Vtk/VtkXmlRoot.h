// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vtk/XmlTags.h"

namespace smg
{

/**
 * The tag <VTKFile>, which comes first. Throws Error if it does not, or if the file does not end
 * with its closing tag.
 */
XmlTag vtkXmlRoot(InputFile& file, XmlTags& tags);

} // namespace smg
