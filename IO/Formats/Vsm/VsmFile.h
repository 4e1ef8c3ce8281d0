// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"
#include "IO/Formats/Vsm/VsmFormat.h"
#include "Solver/Core/Progress.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Reads rows of a column of a block file, independent of its blocks. Keeps the last block, so that
 * rows in ascending order read each block once. */
class RowReader
{
public:
  RowReader(BlockFileReader& file, int table, int column);

  std::size_t tupleBytes() const { return this->TupleBytes; }

  /** Reads the rows [first, first + count). */
  void read(std::int64_t first, std::int64_t count, std::byte* values);
  /** Reads the rows `rows`, in ascending order. */
  void gather(std::span<const std::int64_t> rows, std::byte* values);

private:
  void load(std::int64_t block);

  BlockFileReader* File;
  int Table, Column;
  std::size_t TupleBytes;
  std::int64_t Block = -1;
  std::vector<std::byte> Bytes; ///< of that block
};

/** An open .vsm file: its verified header, and the decoding of its blocks. */
class VsmFile
{
public:
  /** @param fingerprint unless empty, that which the file must have; see fingerprint() */
  VsmFile(const std::filesystem::path& path, IoStatistics* statistics,
    const std::string& fingerprint = {});

  [[noreturn]] void fail(const std::string& what) const;
  /** The same of a memory limit that is too low. */
  [[noreturn]] void failForMemory(const std::string& what) const;

  /** Stands for the content of the whole file. */
  std::string fingerprint() const { return std::to_string(this->Blocks.contentChecksum()); }

  /** Vertices introduced before a block of the cells; also for the block after the last one. */
  std::int64_t firstVertex(std::int64_t block) const { return this->FirstVertex[block]; }
  /** The block of the cells that introduces a vertex. */
  std::int64_t blockIntroducing(std::int64_t vertex) const
  {
    return std::ranges::upper_bound(this->FirstVertex, vertex) - this->FirstVertex.begin() - 1;
  }
  /** No cell after the block uses a vertex below this. */
  std::int64_t finalized(std::int64_t block) const { return this->Finalized[block]; }
  std::int64_t cellBlocks() const { return this->Blocks.blocks(VsmFormat::Cells); }

  /** Reads the corners of a block of the cells as stream indices, and checks them. */
  void readCorners(std::int64_t block, std::vector<std::int64_t>& corners);
  /** Reads the last cells of the vertices of a block of the vertices. */
  void readLastCells(std::int64_t block, std::vector<std::int64_t>& cells);

  /** The number of vertices of no cell, which are separate from the stream. */
  std::int64_t isolatedVertices() const
  {
    return this->HasIsolated ? this->Blocks.rows(VsmFormat::Isolated) : 0;
  }

  /** Bytes of the largest blocks: of vertices and of cells in the file, and of the stream with all
   * columns. */
  std::int64_t blockBytes() const;

  /** The index of the column of this name in its table. */
  int vertexColumn(const std::string& name) const
  {
    return this->find(this->Info.vertexColumns, name, "vertex");
  }
  int cellColumn(const std::string& name) const
  {
    return this->find(this->Info.cellColumns, name, "cell");
  }

  /** The table of the groups. */
  static TableSpec groupTable() { return { "groups", { { "Json", ScalarType::UInt8, 0 } } }; }

  StreamInfo Info;
  double MeanWidth = 0;
  BlockFileReader Blocks;

private:
  void readHeader();
  void readTables();
  void readGroups();
  void checkColumns() const;
  void checkGroups() const;
  void checkBlocks() const;
  void readBlockTable();
  int find(const std::vector<ColumnSpec>& columns, const std::string& name, const char* kind) const;
  void readPacked(int table, std::int64_t block, std::size_t count);

  std::string Name;
  bool HasIsolated = false; ///< whether the table exists, possibly without rows
  std::vector<std::int64_t> FirstVertex;
  std::vector<std::int64_t> Finalized;
  std::vector<std::byte> Packed;
  std::vector<std::uint64_t> Numbers;
};

/**
 * Reads a whole .vsm file, unlike all other operations, and verifies the checksum of every column
 * of every block.
 * @return the number of blocks
 * @throws Error naming the file, the table and the block if one is wrong; Cancelled
 */
SMG_EXPORT std::int64_t checkVsm(
  const std::filesystem::path& path, const ProgressFunction& progress = {});

} // namespace smg
