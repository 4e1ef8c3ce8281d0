// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/** Prints the counts, the peak, and what flows through each condition, of the report of a solve,
 * which is JSON. */
void printReport(const std::string& json);
