// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace smg
{

/** The error of an invalid JSON text with its position, for example `line 2, column 13: this is not
 * valid JSON: unexpected character 'x'`. Columns count characters of the line, from 1. */
std::string jsonComplaint(const std::string& text);

} // namespace smg
