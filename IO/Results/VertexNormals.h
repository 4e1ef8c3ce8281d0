// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/PagedArray.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Files/CheckedFile.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/MovedMesh.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace smg
{

/**
 * The unit normals at the vertices of a mesh stream of triangles, on disk: the mean of the
 * normals of a vertex's triangles, weighted by their angles at the vertex. Triangles without area,
 * and those marked as degenerate or duplicate in CellFlags, are ignored; a vertex without any other
 * has the normal (0, 0, 0).
 *
 * They are computed in one pass; a vertex is released as soon as it is final. The result does not
 * depend on the blocks of the stream.
 */
class SMG_EXPORT VertexNormals
{
public:
  /**
   * Reads the stream, which delivers at least its CellFlags, if any, to its end.
   * @throws Error if the cells are no triangles or a scratch file fails; Cancelled
   */
  explicit VertexNormals(MeshSource& mesh, const NormalsOptions& options = {});

  std::int64_t vertices() const { return this->Vertices; }
  /**
   * Writes the normals of the vertices [first, first + count) to `normals`, 3 floats per vertex.
   * Any range in any order. Throws Error.
   */
  void read(std::int64_t first, std::int64_t count, std::span<float> normals) const;

private:
  CheckedFile File;
  std::int64_t Vertices = 0;
};

/** A triangle's unit normal and its angles; all zero if it has no area. */
struct TriangleShape
{
  std::array<double, 3> normal{};
  std::array<double, 3> angles{}; ///< radians, at the corners a, b, c
};

/** The shape of a triangle; its normal is that of (b - a) x (c - a). */
SMG_EXPORT TriangleShape shapeOfTriangle(
  std::span<const double, 3> a, std::span<const double, 3> b, std::span<const double, 3> c);

/** The shapes of the triangles of a mesh stream, block by block; stores the positions of the
 * vertices that are not final. */
class CellNormals
{
public:
  /** At most `memory` bytes are in memory; the rest is in a scratch file in `scratch` (empty: the
   * system's temporary folder). */
  CellNormals(const std::filesystem::path& scratch, std::int64_t memory);

  /** Adds the vertices of the next block. */
  void take(const MeshBlock& block);
  /** The shape of cell `cell`, counted from 0, of the last block. */
  TriangleShape shape(const MeshBlock& block, std::size_t cell);
  /** Adds the next block and writes the normals of its cells, 3 floats per cell. */
  void read(const MeshBlock& block, std::span<float> normals);
  /** Releases the vertices that are final after the block. */
  void release(const MeshBlock& block) { this->Positions.discardBelow(block.finalized); }

private:
  ScratchFolder Scratch;
  PagedArray<std::array<double, 4>> Positions; ///< x, y, z, by stream index
};

/** Adds the normal of a triangle, weighted with its angle at corner `k`, to the sum there. */
inline void addNormal(const TriangleShape& shape, std::size_t k, std::span<double, 3> sum)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    sum[axis] += shape.angles[k] * shape.normal[axis];
  }
}

/** The unit vector along a sum; zero if that is zero. */
SMG_EXPORT std::array<float, 3> unitNormal(std::span<const double, 3> sum);

/** Triangles of a mesh in memory. */
struct TriangleView
{
  std::span<const double> positions;     ///< x, y, z of each vertex
  std::span<const std::int64_t> corners; ///< three a triangle
  std::span<const std::uint8_t> flags;   ///< see CellFlag; empty: none
};

/** The sums of normals at the vertices of a part of a mesh, 3 numbers each, as VertexNormals has
 * them: those of all parts together have the directions of the normals. */
SMG_EXPORT std::vector<double> normalSums(const TriangleView& triangles);

/** The unit normals of such sums, 3 numbers a vertex. */
SMG_EXPORT std::vector<float> unitNormals(std::span<const double> sums);

/** The unit normals of the triangles, 3 numbers each, as CellNormals has them. */
SMG_EXPORT std::vector<float> normalsOf(const TriangleView& triangles);

} // namespace smg
