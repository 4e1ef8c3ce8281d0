// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace smg::testing
{

/**
 * The text of the value at a place (a JSON pointer, as "/conditions/0/flux") of a JSON text. For
 * files that include VTK: newer releases have a JSON library of their own, under the same names.
 */
std::string jsonAt(const std::string& text, const std::string& place);
/** The same of a number. */
double numberAt(const std::string& text, const std::string& place);

} // namespace smg::testing
