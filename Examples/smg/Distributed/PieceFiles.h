// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/Team.h"
#include "smg/Column.h"
#include "smg/VsmReader.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <utility>
#include <vector>

/** What the piece of a process gets. */
struct PieceResult
{
  std::function<bool(const smg::ColumnSpec&)> replaces; ///< the columns of the mesh to leave out
  std::vector<smg::Column> vertexColumns, cellColumns;
  std::vector<double> positions; ///< of the vertices; empty: those of the mesh

  /** Adds a column with these values. */
  template <class T>
  static void add(std::vector<smg::Column>& columns, const char* name, int components,
    const std::vector<T>& values);
};

/** Called on one process, before the work: throws smg::Error if pieces of this mesh cannot be
 * written, because of its cells, or because of the folder or its room. */
void checkPieceFiles(const smg::StreamInfo& mesh, const std::filesystem::path& out);

/** Writes the mesh with its result as a .pvtp or .pvtu file, each process the piece of its cells,
 * in the folder of that name. Pieces have GlobalIds, vtkGhostType and StreamFinalized as those of
 * vtkStreamingMeshReader. Those of an earlier result of this name are replaced, or removed; the
 * index, without which pieces are no result, is there only when all of them are. Called on all
 * processes; throws smg::Error, and leaves nothing of the result then. */
void writePieceFiles(
  smg::Team& team, smg::VsmReader& mesh, PieceResult result, const std::filesystem::path& out);

template <class T>
void PieceResult::add(
  std::vector<smg::Column>& columns, const char* name, int components, const std::vector<T>& values)
{
  smg::Column column{ { name, smg::scalarTypeOf<T>(), components }, {} };
  const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
  column.bytes.assign(bytes.begin(), bytes.end());
  columns.push_back(std::move(column));
}
