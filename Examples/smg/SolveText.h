// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Report.h"
#include "smg/Solve.h"

/** Warns of a solve, or of steps of it, without convergence. */
void warnOfSolve(const smg::Report& report, const smg::SolveOptions& options);
/** Prints what a solve found: convergence, steps, conditions, seams. */
void printSolve(const smg::Report& report);
