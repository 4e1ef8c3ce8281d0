// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace smg::testing
{

/** The text of the value at a JSON pointer such as "/conditions/0/flux" in a JSON text. For files
 * that include VTK, whose later releases bundle a JSON library under the same names. */
std::string jsonAt(const std::string& text, const std::string& place);
/** The same for a number. */
double numberAt(const std::string& text, const std::string& place);

} // namespace smg::testing
