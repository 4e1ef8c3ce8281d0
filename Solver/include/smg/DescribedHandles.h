// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Deform.h"
#include "smg/DeformationDescription.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

class MeshParts;

/**
 * The handles of a DeformationDescription on a mesh stream.
 *
 *     DescribedHandles handles(description, mesh.info());
 *     handles.prepare(*mesh.source(handles.vertexColumns(), handles.cellColumns()));
 *     deform(*mesh.source(handles.vertexColumns(), handles.cellColumns()), handles, options);
 *
 * Vertices are numbered by the column OriginalId (int64), or by their stream index if the mesh has
 * no such column.
 */
class SMG_EXPORT DescribedHandles : public Handles
{
public:
  /**
   * Checks the description against the mesh.
   * @param description what is held and how it moves
   * @param mesh the mesh that the handles are for
   * @param name what error messages call the description, for instance its file
   * @throws Error naming the place in the description if a region is not valid, or the mesh lacks a
   * column or has it with another number of components
   */
  DescribedHandles(const DeformationDescription& description, const StreamInfo& mesh,
    const std::string& name = "deformation");
  ~DescribedHandles() override;

  /** Names of the vertex columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const;
  /** Names of the cell columns that the mesh source must deliver. */
  std::vector<std::string> cellColumns() const;

  /**
   * Reads the stream once and checks that every handle holds a vertex. Required only where vertices
   * are selected by a cell column, as the nearest ones or as the boundary; optional otherwise.
   * Writes an unnamed scratch file of one bit a vertex for each cell column that selects, and for
   * each boundary.
   * @param mesh the stream, from its first block
   * @param scratch folder for scratch files; empty: the system's temporary folder
   * @param memoryLimit as in SolveOptions; 1 GiB by default
   * @throws Error naming the handle if it holds no vertex, or names a vertex that the mesh lacks;
   * naming the memory that is needed if the limit does not suffice
   */
  void prepare(MeshSource& mesh, const std::filesystem::path& scratch = {},
    std::int64_t memoryLimit = std::int64_t(1) << 30);
  /** The first half of prepare(), for the part of the mesh that a process has: see
   * DistributedSolver. */
  void preparePart(MeshSource& part, const std::filesystem::path& scratch = {},
    std::int64_t memoryLimit = std::int64_t(1) << 30);
  /** The second half of prepare(), in which the processes of all parts take part. */
  void endPreparing(MeshParts& parts);

  void at(const MeshBlock& block, VertexHandles& handles) override;
  std::int64_t bytes() const override;

  /**
   * Remarks for the user, a sentence each, once at() has been called for all blocks: handles whose
   * vertices all follow later ones, and whether no handle moves anything.
   */
  std::vector<std::string> notes() const;
  /** The same of the whole mesh, of which at() was called for the part of each process. */
  std::vector<std::string> notes(MeshParts& parts) const;

private:
  struct OnMesh;
  std::unique_ptr<OnMesh> Data;
};

} // namespace smg
