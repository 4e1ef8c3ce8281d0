// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Export.h"

#include <string>

namespace smg
{

/** The name of a scalar type in VTK's XML files: "Int8", "UInt8" ... "Float64". */
SMG_EXPORT std::string vtkXmlTypeName(ScalarType type);

/** The text with the characters that mean something in XML written as entities. */
SMG_EXPORT std::string xmlEscaped(const std::string& text);

} // namespace smg
