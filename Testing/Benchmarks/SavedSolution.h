// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Solve.h"

#include <filesystem>

namespace smg::benchmark
{

/** Copies a solution to a file of doubles, one range at a time. Throws Error. */
void saveSolution(Solution& solution, const std::filesystem::path& file);

/** The largest distance between the points x, y, z of two such files. Throws Error. */
double largestDistance(const std::filesystem::path& file, const std::filesystem::path& other);

} // namespace smg::benchmark
