// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace smg::testing
{

/**
 * The .vsm file of which these bytes are what is left without the zeros that follow the header,
 * with right checksums: of 2^64 changed files the checksums let one pass, so that changes would
 * never meet what comes after them. Bytes that are no such file stay as they are.
 */
std::string sealedVsm(std::string_view bytes);

} // namespace smg::testing
