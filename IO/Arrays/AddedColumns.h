// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/ArrayView.h"
#include "IO/Arrays/OriginalOrder.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/VsmReader.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

/** A stored mesh with columns from arrays, which have a row for each vertex or cell in the original
 * order. The arrays are not copied: they must not change or go before this and its sources. */
class SMG_EXPORT AddedColumns : public StoredMesh
{
public:
  /** A mesh with a StoredMesh::file(), and its order. */
  AddedColumns(std::shared_ptr<const StoredMesh> mesh, std::shared_ptr<const OriginalOrder> order);

  /** Adds a column, in place of one of this name. `isArgument`: one that jobs alone have. Throws
   * ArgumentError if the array has another number of rows, the name is one that the library gives a
   * meaning of its own, or that of an argument is the name of a column of the mesh. */
  void add(bool ofCells, const std::string& name, const ArrayView& values, bool isArgument = false);

  /** Takes an added column away, if there is one of this name. */
  void remove(bool ofCells, const std::string& name);
  bool isEmpty() const { return this->OfVertices.empty() && this->OfCells.empty(); }

  const StreamInfo& info() const override { return this->Info; }
  std::unique_ptr<MeshSource> source(
    std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const override;
  /** That of the mesh, and of the numbers of all arrays. */
  std::string fingerprint() const override;
  std::filesystem::path file() const override { return this->Mesh->file(); }
  std::string fileFingerprint() const override { return this->Mesh->fileFingerprint(); }

  /** Adds the added columns to vertices of no cell that were read from the file(), in place of
   * those of the same names; `first` is the number of the first one. */
  void completeIsolated(std::int64_t first, IsolatedVertices& vertices) const;

  /** An added column. */
  struct Added
  {
    ColumnSpec spec;
    ArrayView values;
    bool isArgument; ///< of jobs, no part of the mesh
  };
  /** The column of this name if it was added, else null. */
  const Added* find(bool ofCells, const std::string& name) const;
  const OriginalOrder& order() const { return *this->Order; }

  /** The same without the arguments; null: no column is left. */
  std::shared_ptr<const AddedColumns> withoutArguments() const;

private:
  void setInfo();

  std::shared_ptr<const StoredMesh> Mesh;
  std::shared_ptr<const OriginalOrder> Order;
  StreamInfo Info;
  std::vector<Added> OfVertices, OfCells;
};

} // namespace smg
