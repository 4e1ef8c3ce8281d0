// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** Makes SIGINT, SIGTERM and SIGHUP (unless ignored) cancel the running operation with a clean-up,
 * instead of terminating the program. A second signal terminates it. */
void catchInterrupts();

/** Whether such a signal has been received. */
bool interrupted();
