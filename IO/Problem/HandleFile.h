// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Deformation/DeformationDescription.h"

#include <filesystem>

namespace smg
{

/**
 * Reads a handle file:
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
 * A region is any WHERE of a problem file (see ProblemFile.h), including `tag`, `mask` and
 * `nearest`. A handle has a region and one of three:
 * - `fixed`;
 * - one or more of `rotate`, `scale` (from 1e-20 to 1e20) and `translate`: rotation and scale about
 *   the same centre first, then translation. The axis has any length except 0, the angle is from
 *   -1e6 to 1e6 degrees: 200 is not the same as -160. The centre is part of the rotation or of the
 *   handle; the default is the centre of the sphere or box, and an error for other regions;
 * - `target`, the target of each vertex: the name of a vertex column, [x, y, z] or "position"; with
 *   it optionally `rotation` (the unit axis times the angle in radians: a column or three numbers)
 *   and `logScale` (the natural logarithm of the scale: a column or a number), both by default 0.
 *
 * `cycles` (V-cycles of each step, 1 to 1000000) or `tolerance` (between 0 and 1), but not both,
 * define the stopping criterion; these and `weights` (see Weights in Solver/Problem/Problem.h) are
 * optional.
 * @throws Error naming the file and the place in it
 */
DeformationDescription readHandleFile(const std::filesystem::path& path);

} // namespace smg
