// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/DeformationDescription.h"
#include "smg/Export.h"
#include "smg/ProblemDescription.h"
#include "smg/Region.h"

#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

/**
 * Reads a problem file, which states a problem -div(K grad u - q) + s u = f in JSON:
 *
 *     { "weights": "cotangent" | "clamped" | "uniform", "columns": n,
 *       "conductivity": C, "screening": C, "source": D, "field": "column of the cells",
 *       "initial": D,
 *       "dirichlet": [ { WHERE, "value": D } ],
 *       "flux": [ { WHERE, "value": D } ],
 *       "robin": [ { WHERE, "coefficient": C, "ambient": D } ],
 *       "soft": [ { WHERE, "weight": C, "value": D } ],
 *       "outputs": [ "gradient", "flux" ], "integrals": [ "chip", "*" ] }
 *
 *     C = number | tensor [xx, yy, zz, xy, yz, xz] (conductivity alone) | "column"
 *         | [ { "value": C }, { WHERE, "value": C }, ... ]
 *     D = [n numbers] | number, if n is 1 | "column" | "position"
 *         | of source and initial also a list as of C
 *     WHERE = "halfspace": [nx, ny, nz, d] | "box": [x0, y0, z0, x1, y1, z1]
 *             | "sphere": [x, y, z, r] | "vertices": [original numbers]
 *             | "tag": ["column", value] | "mask": "column" | "nearest": [[x, y, z], ...]
 *             | "boundary": true
 *
 * An entry without WHERE holds everywhere. Every key is optional; ProblemDescription states what it
 * means. The entries of a list in C cannot be lists themselves. `raw-cotangent` is an old name of
 * `cotangent`. docs/problem.schema.json is the JSON schema.
 * @param path the file
 * @param defaults data of keys that the file does not have; conditions of the file follow theirs
 * @throws Error naming the file and the place in it
 */
SMG_EXPORT ProblemDescription readProblemFile(
  const std::filesystem::path& path, const ProblemDescription& defaults = {});

/**
 * As readProblemFile(), from a text.
 * @param text the content of such a file
 * @param name what error messages call the text
 * @param defaults data of keys that the text does not have
 * @throws Error naming the text and the place in it
 */
SMG_EXPORT ProblemDescription readProblemText(
  const std::string& text, const std::string& name, const ProblemDescription& defaults = {});

/**
 * Reads parts of a mesh from JSON: an object with a single key, WHERE of readProblemFile() or
 * `"everywhere": true`, or a list of these.
 * @param path the file
 * @throws Error naming the file and the place in it
 */
SMG_EXPORT std::vector<Where> readPlacesFile(const std::filesystem::path& path);

/**
 * As readPlacesFile(), from a text.
 * @param text the JSON, for instance `{"boundary": true}`
 * @param name what error messages call the text
 * @throws Error naming the text and the place in it
 */
SMG_EXPORT std::vector<Where> readPlacesText(const std::string& text, const std::string& name);

/**
 * Reads a handle file, which states a deformation in JSON:
 *
 *     { "handles": [ { "region": { "sphere": [x, y, z, r] }, "fixed": true },
 *                    { "region": { "box": [x0, y0, z0, x1, y1, z1] }, "translate": [x, y, z] },
 *                    { "region": { "halfspace": [nx, ny, nz, d] },
 *                      "rotate": { "axis": [x, y, z], "degrees": a, "center": [x, y, z] },
 *                      "scale": s, "translate": [x, y, z] },
 *                    { "region": { "vertices": [original numbers] },
 *                      "scale": s, "center": [x, y, z] },
 *                    { "region": { "mask": "HandleMask" }, "target": "HandleTarget",
 *                      "rotation": "HandleRotation", "logScale": "HandleLogScale" } ],
 *       "weights": "clamped" | "cotangent" | "uniform", "cycles": k }
 *
 * A region is any WHERE of a problem file (see readProblemFile()), except an empty one. A handle
 * has a region and one of the following:
 * - `fixed`;
 * - one or more of `rotate`, `scale` (1e-20 to 1e20) and `translate`: rotation and scale about the
 *   same centre first, then translation. The axis has any length but 0; the angle, from -1e6 to 1e6
 *   degrees, may exceed a half-turn: 200 is not -160. The centre is in the rotation or in the
 *   handle; by default it is the middle of a sphere or box, and required for other regions;
 * - `target`, the new position of each vertex: the name of a vertex column, [x, y, z], "position",
 *   or, of nearest vertices, a list of [x, y, z], one for each point; with it, if they are not 0,
 * `rotation` (the unit axis times the angle in radians: a column or three numbers) and `logScale`
 * (the natural logarithm of the scale: a column or a number).
 *
 * `cycles` (V-cycles of each step, 1 to 1,000,000) or `tolerance` (between 0 and 1, both excluded),
 * but not both, determine when a step stops. They and `weights` (see smg::Weights) are optional.
 * @param path the file
 * @throws Error naming the file and the place in it
 */
SMG_EXPORT DeformationDescription readHandleFile(const std::filesystem::path& path);

/**
 * As readHandleFile(), from a text.
 * @param text the content of such a file
 * @param name what error messages call the text
 * @throws Error naming the text and the place in it
 */
SMG_EXPORT DeformationDescription readHandleText(const std::string& text, const std::string& name);

} // namespace smg
