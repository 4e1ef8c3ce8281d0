// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/**
 * Adds two kinds of lines to ParaView's panels, which our XML asks for by `panel_widget`:
 *   smg_text    a string that cannot be edited, as text that wraps and can be copied
 *   smg_number  a number with its unit, `<Unit text="..."/>` of the hints, beside it
 * Called when the plugin is loaded; does nothing without a window.
 */
void addPanelWidgets();

} // namespace smg
