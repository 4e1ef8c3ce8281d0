// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include <string>
#include <string_view>

namespace smg
{

/** `text` in quotes for error messages, shortened and with unprintable characters replaced. */
SMG_EXPORT std::string inQuotes(std::string_view text);

} // namespace smg
