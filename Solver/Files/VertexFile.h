// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/BlockStore.h"
#include "Solver/Files/CheckedFile.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Memory/Buffer.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace smg
{

/** Where a VertexFile keeps its values. */
struct VertexStorage
{
  Pool& pool;                  ///< accounts for values in memory
  const ScratchFolder* folder; ///< of the files; null: in memory
  IoStatistics& traffic;       ///< of the files
};

/** A tuple of numbers for each vertex of a mesh stream, in an unnamed scratch file or in memory. */
class SMG_EXPORT VertexFile
{
public:
  VertexFile(const VertexStorage& storage, int lanes);

  int lanes() const { return static_cast<int>(this->Lanes); }
  std::int64_t vertices() const { return this->Vertices; }

  /** Adds the tuples of the next vertices. */
  void append(std::span<const double> values);
  /** The next vertex to append is vertex 0; memory or file are used again. */
  void restart();
  /** Reads the tuples of the vertices [first, first + count), which must exist. */
  void read(std::int64_t first, std::int64_t count, double* values) const;

private:
  Pool* Memory;
  IoStatistics* Traffic;
  std::size_t Lanes;
  CheckedFile File; ///< closed: in memory
  Buffer Values;
  std::int64_t Vertices = 0;
};

/** A set of the vertices of a mesh stream in an unnamed scratch file, one bit per vertex. */
class VertexSetFile
{
public:
  /** The file is created in `folder`; empty: the system's temporary folder. */
  explicit VertexSetFile(const std::filesystem::path& folder);

  /** Adds the next vertices: 1 if in the set, else 0. */
  void append(std::span<const std::uint8_t> selected);
  /** To be called after the last vertex. */
  void finish();

  /** Reads the values passed to append() for the vertices from `first` on. */
  void read(std::int64_t first, std::span<std::uint8_t> selected);
  /** Whether the set has this vertex; fast if it is close to the vertex of the last call. */
  bool contains(std::int64_t vertex);

private:
  static constexpr std::size_t BlockBytes = std::size_t(64) << 10;
  static constexpr auto BlockVertices = static_cast<std::int64_t>(8 * BlockBytes);

  IoStatistics Statistics;
  BlockStore File;
  std::vector<std::byte> Bits; ///< of the current block
  std::int64_t Block = 0;      ///< its number
  std::int64_t Next = 0;       ///< the next vertex of append()
};

} // namespace smg
