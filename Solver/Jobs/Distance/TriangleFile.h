// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/BlockStore.h"
#include "Solver/Jobs/Distance/TriangleTree.h"
#include "Solver/Memory/Buffer.h"
#include "Solver/Memory/Pool.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** A triangle on a scratch file: its corners, and their numbers in the original file. */
struct NumberedTriangle
{
  TrianglePoints points;
  std::array<std::int64_t, 3> numbers;
};

/** Appends triangles to a scratch file, in blocks of fixed length, so that any of them is found by
 * division. */
class TriangleWriter
{
public:
  static constexpr std::int64_t BlockTriangles = 4096;

  explicit TriangleWriter(BlockStore& to)
    : To(to)
  {
    this->Block.reserve(BlockTriangles);
  }

  void add(const NumberedTriangle& triangle);
  /** To be called after the last triangle. */
  void finish();
  std::int64_t count() const { return this->Count; }

private:
  void writeBlock();

  BlockStore& To;
  std::vector<NumberedTriangle> Block; ///< not yet written
  std::int64_t Count = 0;
};

/** The triangles of a file from one on that are in memory at once, with their tree. */
class TrianglePart
{
public:
  /** How many of `triangles` fit into the memory, beside `other` bytes: all of them, or the largest
   * multiple of a block that there is room for. Throws MemoryLimitError if that is none. */
  static std::int64_t lengthFor(std::int64_t triangles, std::int64_t other, const Pool& pool);

  /** Reads `count` triangles from `first` on, where both are multiples of a block except at the end
   * of the file. */
  TrianglePart(BlockStore& file, std::int64_t first, std::int64_t count, Pool& pool);

  std::span<const TrianglePoints> points() const { return this->Points; }
  /** Of the corners of a triangle, the number of the one that is nearest to a point. */
  std::int64_t numberNearest(std::int64_t triangle, const double* point) const;
  const TriangleTree& tree() const { return *this->Tree; }

private:
  void read(BlockStore& file, std::int64_t first);

  Buffer PointMemory, NumberMemory;
  std::span<TrianglePoints> Points;
  std::span<std::array<std::int64_t, 3>> Numbers;
  std::optional<TriangleTree> Tree;
};

} // namespace smg
