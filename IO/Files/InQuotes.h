// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace smg
{

/** `text`, shortened and with unprintable characters replaced, in quotes: for errors. */
std::string inQuotes(std::string_view text);

} // namespace smg
