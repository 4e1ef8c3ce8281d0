// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Pool.h"
#include "smg/Column.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/ProblemDescription.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

/** The owner of a column: vertices or cells. */
enum class ColumnOwner
{
  Vertices,
  Cells
};

/** Whose column a value names, if vertices and cells both have it. */
inline ColumnOwner ownerOf(const DataValue& value, ColumnOwner usual)
{
  return value.owner() == DataValue::Owner::Usual   ? usual
         : value.owner() == DataValue::Owner::Cells ? ColumnOwner::Cells
                                                    : ColumnOwner::Vertices;
}

/** A column of a mesh that a problem description names. */
struct NamedColumn
{
  std::string name;
  ColumnOwner owner = ColumnOwner::Vertices;
  int components = 1;

  /** The column in a block; throws Error if the mesh source does not deliver it. */
  const Column& in(const MeshBlock& block) const;
};

/** The columns of a mesh that a problem description names: finds them, collects those that the mesh
 * source must deliver, reports errors, and accounts for the memory of their values. */
class SMG_EXPORT MeshColumns
{
public:
  /** `description`: what error messages call the description, for instance its file. `memory`: see
   * memory(); null: a pool of its own, at first without a limit. */
  MeshColumns(const StreamInfo& mesh, std::string description, Pool* memory = nullptr);
  MeshColumns(const MeshColumns&) = delete;
  MeshColumns& operator=(const MeshColumns&) = delete;

  CellType cellType() const { return this->Info.cellType; }
  /** The number of its cells. */
  std::int64_t cells() const { return this->Info.cells; }
  /** The pool that accounts for what selections and values keep of open vertices. */
  Pool& memory() const { return *this->Memory; }

  /** Whether `name` refers to a column of the cells, if columns of `preferred` take precedence. */
  bool isOfCells(const std::string& name, ColumnOwner preferred) const;

  /** Finds a column and requests its delivery. If there is none, throws Error, which names the
   * place `key` of the description and the existing columns. */
  NamedColumn require(const std::string& name, ColumnOwner preferred, const std::string& key);
  /** The groups of the mesh. */
  const MeshGroups& groups() const { return this->Info.groups; }
  /** Whether anything of the mesh is in a group of this kind. */
  bool hasGroupColumn(GroupOf kind) const;
  /** Requests the column of the sets of groups of this kind, which the mesh must have. */
  NamedColumn requireGroups(GroupOf kind);
  /** Requests the original indices of the vertices, if any. */
  void requireIds() { this->NeedsIds = true; }
  /** The same for the cells. */
  void requireCellIds() { this->NeedsCellIds = true; }

  /** The columns that the mesh source must deliver: the required ones and, if there are any, the
   * original indices, for error messages. */
  std::vector<std::string> vertexColumns() const;
  std::vector<std::string> cellColumns() const;

  /** The column of the original indices of the vertices; null: the stream indices are used. */
  const Column* ids(const MeshBlock& block) const;
  /** The name of vertex `i` or cell `c` of the block in messages. */
  std::string vertexName(const MeshBlock& block, std::size_t i) const;
  std::string cellName(const MeshBlock& block, std::size_t c) const;

  /** Throws Error: "DESCRIPTION: KEY: SENTENCE." */
  [[noreturn]] void fail(const std::string& key, const std::string& sentence) const;

private:
  StreamInfo Info;
  std::string Description;
  std::unique_ptr<Pool> Own;
  Pool* Memory;
  std::vector<std::string> Vertices, Cells; ///< names of the required columns
  bool NeedsIds = false, NeedsCellIds = false;
};

/** Whether a number of an integer column may have lost digits when it became this double: its
 * magnitude is 2^53 or more. */
inline bool isInexact(ScalarType type, double number)
{
  constexpr double MinInexact = 9007199254740992.0;
  const bool isInteger = type != ScalarType::Float32 && type != ScalarType::Float64;
  return isInteger && std::fabs(number) >= MinInexact;
}

/** Why this number of a column cannot be computed with, to follow "the column ..." in a message;
 * null if it can. */
inline const char* flawOf(ScalarType type, double number)
{
  return !std::isfinite(number) ? "is not a finite number"
         : isInexact(type, number)
           ? "has an integer of 2^53 or more, which double precision cannot hold exactly,"
           : nullptr;
}

/** Counts the values that are outside the range of the type of their column after rounding, and
 * will be set to its smallest or largest number: sets Report::clipped, and adds a note if there are
 * any. The components of `columns`, one after the other, are the columns of the solution. */
void countClipped(Solution& solution, const std::vector<ColumnSpec>& columns, Report& report);

} // namespace smg
