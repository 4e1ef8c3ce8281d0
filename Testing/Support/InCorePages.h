// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Pages/PageBuilder.h"
#include "Testing/Support/InCoreOrder.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg::testing
{

/** The vertices of a mesh along a Morton curve. */
std::vector<std::uint32_t> alongCurve(std::span<const double> positions);

/** Pages of the vertices in the order of `curve`, built in memory; a vertex that is not in it must
 * not have neighbours. The indices in the raw mesh are those in the graph. */
PagedMesh pagesOf(const Neighbours& neighbours, std::span<const double> positions,
  std::span<const std::uint32_t> curve, int pageVertices, bool doublePositions,
  Workspace& workspace);

/** Pages of a whole mesh along a curve. */
PagedMesh pagesOf(const IndexedTestMesh& mesh, int pageVertices, Workspace& workspace);

/** Reads an order: the raw indices of the vertices, and their reaches. */
struct ReadOrder
{
  std::vector<std::uint32_t> ids, reaches;
  std::vector<double> positions;
};
ReadOrder readOrder(const OrderedVertices& order);

/** Expects a permutation of `count` vertices whose reaches are the largest positions of their
 * neighbours. */
void expectOrder(const Neighbours& neighbours, const ReadOrder& order, std::size_t count);

} // namespace smg::testing
