// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** Whose a column is. */
enum class ColumnOwner
{
  Vertices,
  Cells
};

/** A column of a mesh that a problem description names. */
struct NamedColumn
{
  std::string name;
  ColumnOwner owner = ColumnOwner::Vertices;
  int components = 1;

  /** The column in a block; throws Error if the mesh source does not deliver it. */
  const Column& in(const MeshBlock& block) const;
};

/**
 * The columns of a mesh for what a problem description says: finds them, knows which ones the mesh
 * source must deliver, and words the complaints.
 */
class SMG_EXPORT MeshColumns
{
public:
  /** `description` is what errors call the description: its file. */
  MeshColumns(const StreamInfo& mesh, std::string description);

  CellType cellType() const { return this->Info.cellType; }

  /** Whether `name` means a column of the cells where one of `preferred` would be taken first. */
  bool isOfCells(const std::string& name, ColumnOwner preferred) const;

  /**
   * Finds a column, and has it delivered. Throws Error naming the place `key` of the description,
   * and the columns that there are, if there is none.
   */
  NamedColumn require(const std::string& name, ColumnOwner preferred, const std::string& key);
  /** Has the original numbers of the vertices delivered, if there are any. */
  void requireIds() { this->NeedsIds = true; }
  /** The same of the cells. */
  void requireCellIds() { this->NeedsCellIds = true; }

  /** The columns that the mesh source must deliver: those that were required and, beside these, the
   * original numbers, for complaints. */
  std::vector<std::string> vertexColumns() const;
  std::vector<std::string> cellColumns() const;

  /** The column of the original numbers of the vertices; null: stream indices are the numbers. */
  const Column* ids(const MeshBlock& block) const;
  /** What a user calls vertex `i` or cell `c` of the block. */
  std::string vertexName(const MeshBlock& block, std::size_t i) const;
  std::string cellName(const MeshBlock& block, std::size_t c) const;

  /** Throws Error: "DESCRIPTION: KEY: SENTENCE." */
  [[noreturn]] void fail(const std::string& key, const std::string& sentence) const;

private:
  StreamInfo Info;
  std::string Description;
  std::vector<std::string> Vertices, Cells; ///< names of those that were required
  bool NeedsIds = false, NeedsCellIds = false;
};

} // namespace smg
