// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/SolidBoundary.h"

#include <algorithm>
#include <span>
#include <vector>

// The outer surface of a stream of tetrahedra, by a hash table of open faces: a face that comes a
// second time is inside and is removed, one that has only one tetrahedron when a corner is final is
// on the boundary. The table has the faces of the window of the stream; it is searched as a whole
// only when it has grown enough for that to pay.

namespace smg
{

std::size_t OpenFaces::Hash::operator()(const Face& face) const
{
  std::uint64_t hash = 0;
  for (const std::int64_t corner : face)
  {
    // Multiplication spreads neighbouring numbers, which corners are, over all bits.
    hash = (hash ^ static_cast<std::uint64_t>(corner)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  }
  return hash;
}

void OpenFaces::add(std::span<const std::int64_t, 4> corners)
{
  // The corners of each face, outwards if the tetrahedron has a positive volume.
  constexpr int faces[4][3] = { { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 }, { 0, 2, 1 } };
  for (const auto& [a, b, c] : faces)
  {
    const Face outward{ corners[a], corners[b], corners[c] };
    Face sorted = outward;
    std::sort(sorted.begin(), sorted.end());
    const auto [entry, isNew] = this->Open.try_emplace(sorted, outward);
    // The second tetrahedron of the face.
    if (!isNew)
    {
      this->Open.erase(entry);
    }
  }
}

void OpenFaces::closeBelow(std::int64_t finalized, const std::function<void(const Face&)>& outer)
{
  for (auto entry = this->Open.begin(); entry != this->Open.end();)
  {
    // The least corner is final, so no further tetrahedron has the face.
    if (entry->first[0] < finalized)
    {
      outer(entry->second);
      entry = this->Open.erase(entry);
    }
    else
    {
      ++entry;
    }
  }
}

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
  if (!this->IsAtEnd && this->Mesh.next(block))
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
  // A block of faces alone, after the last vertices.
  block = {};
  block.firstVertex = block.finalized = this->Vertices;
  this->close(this->Vertices, block);
  return !block.corners.empty();
}

/** Replaces tetrahedra by the faces of the boundary that are known. */
void SolidBoundary::replaceCells(MeshBlock& block)
{
  const Column* flags = block.flags();
  for (std::size_t c = 0; c + 3 < block.corners.size(); c += 4)
  {
    if (!flags || (flags->as<std::uint8_t>()[c / 4] & DuplicateCell) == 0)
    {
      this->Faces.add(std::span<const std::int64_t, 4>(block.corners.data() + c, 4));
    }
  }
  block.corners.clear();
  block.cellColumns.clear();
  this->Vertices += block.vertices();
  // To find the faces that are complete, all open ones are looked at. This pays if there are many
  // more of them than the last time, or many more vertices that they keep open.
  const std::size_t usual = this->FacesKept + 20000;
  if (this->Faces.size() > 2 * usual ||
      static_cast<std::size_t>(this->Vertices - this->ClosedAt) > usual)
  {
    this->close(block.finalized, block);
    this->FacesKept = this->Faces.size();
    this->ClosedAt = this->Vertices;
  }
  // Faces that were not passed on yet use vertices that the solid declares final.
  block.finalized = this->Final;
}

/** Appends the faces that no later cell has, sorted by their vertices: the order of a hash table is
 * not the same everywhere. */
void SolidBoundary::close(std::int64_t final, MeshBlock& block)
{
  std::vector<OpenFaces::Face> faces;
  this->Final = final;
  this->Faces.closeBelow(final, [&faces](const OpenFaces::Face& face) { faces.push_back(face); });
  std::ranges::sort(faces);
  for (const OpenFaces::Face& face : faces)
  {
    block.corners.insert(block.corners.end(), face.begin(), face.end());
  }
}

} // namespace smg
