// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/** Prints the counts, the maximum, and the flow through each condition from the report (JSON) of a
 * solve. */
void printReport(const std::string& json);
