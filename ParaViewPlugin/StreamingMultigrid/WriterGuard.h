// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/**
 * Makes every writer that ParaView knows, now and later, refuse the preview of a reader, the output
 * of a filter that failed and what is made of either, such as a table, as if their data were of
 * another type: only the writers of this plugin take them. It knows both by the names of their
 * field arrays. Called when the plugin is loaded.
 */
void guardWriters();

} // namespace smg
