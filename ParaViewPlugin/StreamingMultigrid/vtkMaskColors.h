// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/** Makes ParaView show the masks of Mesh Handle and Mesh Condition in two colours with names,
 * unless a user has saved other colours for them. Called when the plugin is loaded. */
void colorMasks();

} // namespace smg
