// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace html
{

// The files of this folder, which Embed.cmake turns into strings.
extern const char* const PageStyle;    ///< page.css
extern const char* const ViewerScript; ///< viewer.js

} // namespace html
