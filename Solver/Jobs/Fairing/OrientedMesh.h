// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Fairing/Orientation.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <memory>
#include <string>
#include <vector>

namespace smg
{

/** A surface with some of its triangles turned. Its vertices keep their numbers, so that its
 * streams can be computed with, but not written: see numberedByFirstUse(). */
class SMG_EXPORT OrientedMesh final : public StoredMesh
{
public:
  /** Both must outlive it. */
  OrientedMesh(const StoredMesh& mesh, Orientation& orientation)
    : Mesh(mesh)
    , By(orientation)
  {
  }

  const StreamInfo& info() const override { return this->Mesh.info(); }
  std::unique_ptr<MeshSource> source(
    std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const override;

private:
  const StoredMesh& Mesh;
  Orientation& By;
};

/** A stream with the triangles turned that are to be; `orientation` must outlive it. */
SMG_EXPORT std::unique_ptr<MeshSource> oriented(
  std::unique_ptr<MeshSource> source, Orientation& orientation);

/** A stream of which some triangles were turned, compact as a stream is to be: some triangles begin
 * with another corner, and a few vertices have other numbers. */
SMG_EXPORT std::unique_ptr<MeshSource> numberedByFirstUse(std::unique_ptr<MeshSource> turned);

} // namespace smg
