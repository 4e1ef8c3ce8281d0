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
 * An entry without WHERE holds everywhere. All keys are optional; ProblemDescription documents
 * their meaning and defaults. The entries of a list in C are not lists themselves. `raw-cotangent`
 * is an alias of `cotangent`. docs/problem.schema.json is the corresponding JSON schema. Missing
 * data are taken from `defaults`; conditions are appended to theirs.
 * @throws Error naming the file and the place in it
 */
ProblemDescription readProblemFile(
  const std::filesystem::path& path, const ProblemDescription& defaults = {});

/** The same from the text of such a file, named `name` in error messages. */
ProblemDescription readProblemText(
  const std::string& text, const std::string& name, const ProblemDescription& defaults = {});

} // namespace smg
