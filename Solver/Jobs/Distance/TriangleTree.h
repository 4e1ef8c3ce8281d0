// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "Solver/Memory/Buffer.h"
#include "smg/Export.h"

#include <cstdint>
#include <span>

namespace smg
{

/** Corners of a triangle: three points x, y, z. */
struct TrianglePoints
{
  double point[3][3];
};

/** The point of a triangle that is nearest to a point (Ericson, Real-Time Collision Detection,
 * 2005, 5.1.5). Triangles without area are allowed. */
SMG_EXPORT Vector nearestPoint(const TrianglePoints& triangle, const double* point);

/** A tree of bounding boxes over triangles, which finds the one nearest to a point. */
class TriangleTree
{
public:
  /** Builds the tree; the triangles must outlive it. */
  TriangleTree(Pool& pool, std::span<const TrianglePoints> triangles);

  /** An upper bound of the bytes per triangle. */
  static constexpr std::int64_t BytesPerTriangle = 4 + 32 / 2;

  struct Nearest
  {
    std::int64_t triangle = -1; ///< its number; -1: none is nearer than the bound
    double distance = 0;        ///< to it, or the bound
  };
  /** The triangle nearest to a point, of equally near ones the first, if it is nearer than `bound`.
   * `guess` is a triangle that is probably near, or -1. */
  Nearest nearest(const double* point, double bound, std::int64_t guess) const;

private:
  struct Node
  {
    float low[3], high[3]; ///< contains its triangles
    /** The triangles of a leaf: `count` entries of Order from `first` on. For other nodes, `count`
     * is 0 and `first` is the second child; the first child follows the node. */
    std::uint32_t first, count;
  };
  static constexpr std::int64_t LeafTriangles = 8;

  static std::int64_t nodesFor(std::int64_t triangles);
  std::uint32_t build(std::uint32_t begin, std::uint32_t end);
  /** Sorts the triangles into two halves along the longest side of their centres. */
  void split(std::uint32_t begin, std::uint32_t middle, std::uint32_t end);
  void enclose(Node& node, std::uint32_t begin, std::uint32_t end) const;
  static double squareTo(const Node& node, const double* point);

  std::span<const TrianglePoints> Triangles;
  Buffer OrderMemory, NodeMemory;
  std::span<std::uint32_t> Order; ///< of the triangles in the leaves
  Node* Nodes;
  std::uint32_t NodeCount = 0;
};

} // namespace smg
