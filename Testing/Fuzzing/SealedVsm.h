// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace smg::testing
{

/**
 * Inserts the zeros after the header, which the bytes of the .vsm file lack, and corrects the
 * checksums: these accept one of 2^64 changed files, so that changes would never reach the code
 * after them. Other bytes are returned unchanged.
 */
std::string sealedVsm(std::string_view bytes);

} // namespace smg::testing
