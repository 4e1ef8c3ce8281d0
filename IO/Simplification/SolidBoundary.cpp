// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/SolidBoundary.h"

#include <span>

namespace smg
{

SolidBoundary::SolidBoundary(MeshSource& mesh)
  : Mesh(mesh)
  , Info(mesh.info())
{
  if (this->Info.cellType == CellType::Tetrahedron)
  {
    this->Info.cellType = CellType::Triangle;
    this->Info.cells = 0;
    this->Info.cellColumns.clear();
  }
}

bool SolidBoundary::next(MeshBlock& block)
{
  const bool isSolid = this->Mesh.info().cellType == CellType::Tetrahedron;
  if (this->Mesh.next(block))
  {
    if (isSolid)
    {
      this->replaceCells(block);
    }
    return true;
  }
  if (!isSolid || this->IsAtEnd)
  {
    return false;
  }
  this->IsAtEnd = true;
  block = {};
  block.firstVertex = block.finalized = this->Vertices;
  this->Faces.closeBelow(this->Vertices, [&block](const OpenFaces::Face& face)
    { block.corners.insert(block.corners.end(), face.begin(), face.end()); });
  return !block.corners.empty();
}

/** Replaces tetrahedra by the faces of the boundary that are known. */
void SolidBoundary::replaceCells(MeshBlock& block)
{
  const Column* flags = block.flags();
  for (std::size_t c = 0; c + 3 < block.corners.size(); c += 4)
  {
    if (!flags || flags->as<std::uint8_t>()[c / 4] == 0)
    {
      this->Faces.add(std::span<const std::int64_t, 4>(block.corners.data() + c, 4));
    }
  }
  block.corners.clear();
  block.cellColumns.clear();
  this->Vertices += block.vertices();
  // All open faces are looked at, which is worthwhile if they are many more than the last time.
  if (this->Faces.size() > 2 * this->FacesKept + 100000)
  {
    this->Final = block.finalized;
    this->Faces.closeBelow(this->Final, [&block](const OpenFaces::Face& face)
      { block.corners.insert(block.corners.end(), face.begin(), face.end()); });
    this->FacesKept = this->Faces.size();
  }
  block.finalized = this->Final;
}

} // namespace smg
