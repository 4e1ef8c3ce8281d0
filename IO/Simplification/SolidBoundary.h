// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/OpenFaces.h"
#include "smg/MeshSource.h"

#include <cstddef>

namespace smg
{

/**
 * The outer surface of a stream of tetrahedra as a stream of triangles, oriented outwards, with all
 * vertices of the solid; a stream of triangles as it is. Duplicate cells are left out.
 */
class SolidBoundary : public MeshSource
{
public:
  /** `mesh` must outlive this. */
  explicit SolidBoundary(MeshSource& mesh);

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override;

private:
  void replaceCells(MeshBlock& block);
  void close(std::int64_t final, MeshBlock& block);

  MeshSource& Mesh;
  StreamInfo Info;
  OpenFaces Faces;
  std::size_t FacesKept = 0;
  std::int64_t Final = 0, Vertices = 0;
  std::int64_t ClosedAt = 0; ///< the number of vertices when faces were closed
  bool IsAtEnd = false;
};

} // namespace smg
