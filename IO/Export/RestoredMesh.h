// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/Restorers.h"
#include "IO/External/Relabelling.h"
#include "IO/External/Workspace.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

class VsmReader;

/** The columns without those that a conversion adds, for a format with groups of this form. */
std::vector<ColumnSpec> ownColumns(
  const std::vector<ColumnSpec>& specs, GroupForm groups = GroupForm::None);

/**
 * A .vsm file in the order of its original file: its vertices by the vertex column `OriginalId`,
 * including isolated ones, and its cells by the cell column `OriginalCellId`, polygons as polygons.
 * Works out of core, in the memory of the workspace.
 *
 * The columns added by a conversion (`OriginalId`, `OriginalCellId`, `CellFlags`) are omitted.
 */
class RestoredMesh
{
public:
  /**
   * Reads the stream and sorts it. Reports the workspace's progress up to SortedShare.
   * `maxCorners`: of the polygons that the writer holds, see ElementRestorer. `groups`: their form
   * in the file; if they are sides, elements have the column OriginalCellId, as far as it is known.
   * @throws Error if the file has no OriginalId, its vertices are not all of the original ones, or
   * it cannot be read; Cancelled.
   */
  RestoredMesh(VsmReader& reader, Workspace& workspace, std::int64_t maxCorners,
    GroupForm groups = GroupForm::None);
  RestoredMesh(const RestoredMesh&) = delete;
  RestoredMesh& operator=(const RestoredMesh&) = delete;

  const MeshFileInfo& info() const { return this->Info; }
  /** The workspace of the sort, for further operations. */
  Workspace& workspace() const { return this->Space; }
  /** Notes for the user on the restored mesh, a sentence each. */
  const std::vector<std::string>& notes() const { return this->Notes; }

  /** The next vertices, from 0; returns false at the end. They can be read once. Throws Error;
   * Cancelled. */
  bool next(VertexChunk& vertices);
  /** The next elements, from 0; returns false at the end. Throws Error; Cancelled. */
  bool next(ElementChunk& elements);
  /** Goes back to the first element. */
  void rewindElements() { this->Elements->rewind(); }

  /** The share of the work, 0 to 1, before the mesh can be read. */
  static constexpr double SortedShare = 0.6;

private:
  void readInfo(const VsmReader& reader, GroupForm groups);
  void readVertices(VsmReader& reader, Relabelling& ids, RecordFile<std::uint32_t>& corners);
  void readIsolated(VsmReader& reader);
  void readCells(VsmReader& reader, Relabelling& ids, RecordFile<std::uint32_t>& corners);
  void deliver(std::int64_t count);

  Workspace& Space;
  std::string Name;
  MeshFileInfo Info;
  bool KnowsCells = false; ///< whether there is an OriginalCellId
  std::unique_ptr<VertexRestorer> Vertices;
  std::unique_ptr<ElementRestorer> Elements;
  std::vector<std::string> Notes;
  std::int64_t Delivered = 0; ///< vertices and elements
};

} // namespace smg
