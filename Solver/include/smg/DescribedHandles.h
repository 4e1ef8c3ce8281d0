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
 * Vertices are identified by the column OriginalId, or by their stream index if the mesh has no
 * such column.
 */
class SMG_EXPORT DescribedHandles : public Handles
{
public:
  /**
   * @param mesh the mesh of the handles
   * @param name the name of the description in error messages: its file
   * @throws Error with the place in the description if the mesh has no such column, or one with
   * another number of components
   */
  DescribedHandles(const DeformationDescription& description, const StreamInfo& mesh,
    const std::string& name = "deformation");
  ~DescribedHandles() override;

  /** Names of the columns that the mesh source must deliver. */
  std::vector<std::string> vertexColumns() const;
  std::vector<std::string> cellColumns() const;

  /**
   * Reads the stream once. Optional unless vertices are selected by a column of the cells or as
   * nearest vertices, which is determined here. Writes an unnamed scratch file with one bit per
   * vertex for each such column.
   * @param scratch folder for scratch files; empty: the system's temporary folder
   * @throws Error with the handle if one selects no vertex, or refers to a vertex that the mesh
   * lacks
   */
  void prepare(MeshSource& mesh, const std::filesystem::path& scratch = {});

  /** Throws Error, which names the column and the vertex, if a number is not finite. */
  void at(const MeshBlock& block, VertexHandles& handles) override;

  /** Notes for the user, after all blocks have been queried: handles whose vertices all follow
   * later ones, and a deformation without motion. */
  std::vector<std::string> notes() const;

private:
  std::unique_ptr<HandlesOnMesh> OnMesh;
};

} // namespace smg
