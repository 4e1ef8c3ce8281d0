// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace smg::testing
{

/**
 * The file of a state with edits, and with right sizes and checksums. Its own bytes would be no
 * corpus: they refer to the files of a solve, which differ between compilers. Each edit is
 *
 *     kind      1 byte, modulo 4: 0 replaces, 1 inserts, 2 erases, 3 copies
 *     place     2 bytes, big-endian, modulo the size of the file
 *     count     1 byte, modulo 64
 *     bytes     `count` bytes to replace or insert; or 2 bytes, the place to copy from
 */
std::string editedState(std::string_view state, std::string_view edits);

} // namespace smg::testing
