// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/** Makes ParaView show masks in colours with names, and infinite distances in grey, unless a user
 * has saved other colours for these arrays. Called when the plugin is loaded. */
void colorArrays();

} // namespace smg
