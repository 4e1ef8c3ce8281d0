// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace smg
{

/**
 * What is wrong with a text that a JSON parser does not take, and where, as in `line 2, column 13:
 * this is not valid JSON: unexpected character 'x'`. Columns count characters of the line, from 1.
 */
std::string jsonComplaint(const std::string& text);

} // namespace smg
