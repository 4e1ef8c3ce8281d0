// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace smg
{

/**
 * The weight below which a row is stiff. A sliver of three nearly collinear vertices has weights w
 * on its short edges and -w/2 on the long one: together they resist bending alone, so what is
 * linear along a chain of slivers costs next to nothing. That is a slow error, which interpolation
 * with positive entries cannot express and which small changes of the weights destroy. So a stiff
 * node has a coarse node of its own on every level, and sparsification leaves its row alone.
 *
 * Cotangents have no unit: -2 is half the cotangent of 166 degrees, in one triangle or the sum of
 * two. From -1 to -3 dragon.ply converged as fast, at -8 it did not. On tetrahedra, most of which
 * have negative weights, it did not pay.
 */
inline constexpr float StiffTriangles = -2.0F;
/** No row is stiff. */
inline constexpr float NoneStiff = -std::numeric_limits<float>::infinity();

} // namespace smg
