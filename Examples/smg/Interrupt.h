// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/**
 * Makes SIGINT, SIGTERM and SIGHUP (unless that is ignored) ask the running operation to stop and
 * clean up, instead of ending the program at once. A second signal ends it.
 */
void catchInterrupts();

/** Whether such a signal has come. */
bool interrupted();
