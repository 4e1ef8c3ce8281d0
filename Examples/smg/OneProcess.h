// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** Throws smg::Error if mpiexec has started several processes, which would all do the same and
 * write the same files. */
void requireOneProcess();
