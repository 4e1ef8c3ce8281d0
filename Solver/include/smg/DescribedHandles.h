// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/DeformationDescription.h"
#include "smg/Export.h"
#include "smg/Handles.h"
#include "smg/MeshSource.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

class HandlesOnMesh;

/**
 * The handles of a description on a mesh stream.
 *
 *     DescribedHandles handles(description, mesh.info());
 *     handles.prepare(*mesh.source(handles.vertexColumns(), handles.cellColumns()));
 *     deform(*mesh.source(handles.vertexColumns(), handles.cellColumns()), handles, options);
 *
 * Vertices are named by the column OriginalId, or by their stream index if the mesh has no such
 * column.
 */
class SMG_EXPORT DescribedHandles : public Handles
{
public:
  /**
   * @param mesh the mesh that the handles are for
   * @param name what errors call the description: its file
   * @throws Error naming the place in the description if the mesh has no such column, or one of
   * another number of components
   */
  DescribedHandles(const DeformationDescription& description, const StreamInfo& mesh,
    const std::string& name = "deformation");
  ~DescribedHandles() override;

  /** Names of the columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const;
  std::vector<std::string> cellColumns() const;

  /**
   * Reads the stream once. Optional, except where vertices are selected by a column of the cells or
   * as the nearest ones, which only this finds. Writes a nameless scratch file of one bit a vertex
   * for each such column.
   * @param scratch folder for scratch files; empty: the system's temporary folder
   * @throws Error naming the handle if one selects no vertex, or names a vertex that the mesh does
   * not have
   */
  void prepare(MeshSource& mesh, const std::filesystem::path& scratch = {});

  /** Throws Error naming the column and the vertex if a number there is not finite. */
  void at(const MeshBlock& block, VertexHandles& handles) override;

  /**
   * What a user should know, after all blocks have been asked for: handles whose vertices all
   * follow later ones, and that nothing moves.
   */
  std::vector<std::string> notes() const;

private:
  std::unique_ptr<HandlesOnMesh> OnMesh;
};

} // namespace smg
