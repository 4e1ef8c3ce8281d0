// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/** Makes each view of a preview say how much of the mesh that is, as "100,000 of 2,041,600 points"
 * at its lower edge. Called when the plugin is loaded. */
void nameShownPreviews();

} // namespace smg
