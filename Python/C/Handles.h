// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/AddedColumns.h"
#include "IO/Arrays/OriginalOrder.h"
#include "IO/Formats/UsedFiles.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Convert.h"
#include "smg/Error.h"
#include "smg/MeshSource.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/** An open mesh, which its handle shares with those that were made from it. Its functions may be
 * called on several threads. */
class SharedMesh
{
public:
  /** `name`: the file, or empty for arrays. `state`: of the file before it was read. */
  SharedMesh(std::unique_ptr<OpenedMesh> mesh, std::filesystem::path name, InputState state,
    ConversionOptions options)
    : Mesh(std::move(mesh))
    , Name(std::move(name))
    , State(std::move(state))
    , Options(std::move(options))
  {
  }

  /** The mesh with a result on `of`, in whose order it is, read from a file of `scratch`. `columns`
   * of the vertices are the result. */
  SharedMesh(std::unique_ptr<OpenedMesh> mesh, SharedMesh& of, std::vector<std::string> columns,
    const ProgressFunction& progress, std::shared_ptr<const ScratchFolder> scratch)
    : Mesh(std::move(mesh))
    , Name(of.Name)
    , Options(of.Options)
    , Order(of.order(progress))
    , Scratch(std::move(scratch))
    , Results(of.Results)
  {
    this->Results.insert(columns.begin(), columns.end());
  }

  /** Whether this is the mesh with a result, which the file that was opened does not have. */
  bool isResult() const { return this->Scratch != nullptr; }
  /** Whether a column of the vertices is the result of a job. */
  bool isResult(const std::string& column) const { return this->Results.contains(column); }
  /** The mesh without added columns. */
  const OpenedMesh& mesh() const { return *this->Mesh; }
  /** The file that was opened; empty: the mesh was made of arrays. */
  const std::filesystem::path& name() const { return this->Name; }
  /** The state of this file before it was read. */
  const InputState& state() const { return this->State; }
  /** The number of vertices in the original order. */
  std::int64_t vertices() const
  {
    return this->isResult() ? this->Order->vertices().count
                            : OriginalOrder::countVertices(*this->Mesh);
  }
  /** How it was opened, without the progress function. */
  const ConversionOptions& options() const { return this->Options; }
  /** The original order, found when it is first asked for: others wait for that, therefore the
   * progress function must not use the mesh. Throws Error; Cancelled. */
  std::shared_ptr<const OriginalOrder> order(const ProgressFunction& progress)
  {
    const std::lock_guard lock(this->Mutex);
    if (!this->Order)
    {
      this->Order = std::make_shared<const OriginalOrder>(
        *this->Mesh, this->Mesh->conversion(), progress, this->Options.weld);
    }
    return this->Order;
  }

  /** Throws ArgumentError if a description names vertices by numbers and those that the mesh has
   * are not its rows: the same number would be one vertex here and another one in arrays. */
  void requireRows(const nlohmann::json& description, const ProgressFunction& progress);

private:
  std::unique_ptr<OpenedMesh> Mesh;
  std::filesystem::path Name;
  InputState State;
  ConversionOptions Options;
  std::mutex Mutex;
  std::shared_ptr<const OriginalOrder> Order;
  std::shared_ptr<const ScratchFolder> Scratch; ///< of a result; else null
  std::set<std::string> Results;
};

} // namespace smg

/** A mesh. The added columns are never changed, but replaced: others go on using the old ones. */
struct smg_mesh
{
  std::shared_ptr<smg::SharedMesh> shared;
  std::shared_ptr<const smg::AddedColumns> added; ///< null: none
  std::string text;                               ///< the one last returned

  /** The mesh with its added columns, as jobs see it. */
  const smg::StoredMesh& stored() const
  {
    return this->added ? static_cast<const smg::StoredMesh&>(*this->added) : this->shared->mesh();
  }
  /** The same without columns that are arguments. */
  smg_mesh withoutArguments() const
  {
    return { this->shared, this->added ? this->added->withoutArguments() : nullptr, {} };
  }
};
