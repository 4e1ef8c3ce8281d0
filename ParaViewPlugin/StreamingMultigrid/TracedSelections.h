// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace smg
{

/** Makes a trace and a state of Python hold the selection of a region. ParaView knows no name for a
 * copied selection: for its own Extract Selection it leaves that out, for other filters it writes
 * no state, and of what was set together with the selection nothing is traced. Called when the
 * plugin is loaded. */
void traceSelections();

} // namespace smg
