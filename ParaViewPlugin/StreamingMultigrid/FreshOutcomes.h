// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/** Makes the panels of our proxies show the Outcome, Notes and Error of the last update, and the
 * box of a handle what that holds: ParaView reads such properties when others are applied, which is
 * before the update. Called when the plugin is loaded. */
void refreshOutcomes();

} // namespace smg
