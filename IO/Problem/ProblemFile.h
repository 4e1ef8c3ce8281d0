// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Description/ProblemDescription.h"

#include <array>
#include <filesystem>
#include <string>

namespace smg
{

/** The keys of a problem file. */
inline constexpr std::array ProblemKeys{ "weights", "columns", "conductivity", "screening",
  "source", "field", "initial", "dirichlet", "flux", "robin", "soft", "outputs" };

/**
 * Reads a problem file, -div(K grad u - q) + s u = f:
 *
 *     { "weights": "cotangent" | "clamped" | "uniform", "columns": n,
 *       "conductivity": C, "screening": C, "source": D, "field": "column of the cells",
 *       "initial": D,
 *       "dirichlet": [ { WHERE, "value": D } ],
 *       "flux": [ { WHERE, "value": D } ],
 *       "robin": [ { WHERE, "coefficient": C, "ambient": D } ],
 *       "soft": [ { WHERE, "weight": C, "value": D } ],
 *       "outputs": [ "gradient", "flux" ] }
 *
 *     C = number | tensor [xx, yy, zz, xy, yz, xz] (conductivity alone) | "column"
 *         | [ { "value": C }, { WHERE, "value": C }, ... ]
 *     D = [n numbers] | number, if n is 1 | "column" | "position"
 *         | of source and initial also a list as of C
 *     WHERE = "halfspace": [nx, ny, nz, d] | "box": [x0, y0, z0, x1, y1, z1]
 *             | "sphere": [x, y, z, r] | "vertices": [original numbers]
 *             | "tag": ["column", value] | "mask": "column" | "nearest": [[x, y, z], ...]
 *
 * An entry without WHERE holds everywhere. Every key may be left out; ProblemDescription says what
 * it means and what holds without it. The entries of a list in C have no lists themselves.
 * `raw-cotangent` is an old name of `cotangent`. docs/problem.schema.json says the same as a JSON
 * schema. What the file does not say is as in `defaults`; conditions are added to theirs.
 * @throws Error naming the file and the place in it
 */
ProblemDescription readProblemFile(
  const std::filesystem::path& path, const ProblemDescription& defaults = {});

/** The same from the text of such a file; errors call it `name`. */
ProblemDescription readProblemText(
  const std::string& text, const std::string& name, const ProblemDescription& defaults = {});

} // namespace smg
