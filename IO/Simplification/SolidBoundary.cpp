// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/SolidBoundary.h"

#include <algorithm>
#include <span>
#include <vector>

namespace smg
{

std::size_t OpenFaces::Hash::operator()(const Face& face) const
{
  std::uint64_t hash = 0;
  for (const std::int64_t corner : face)
  {
    hash = (hash ^ static_cast<std::uint64_t>(corner)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  }
  return hash;
}

void OpenFaces::add(std::span<const std::int64_t, 4> corners)
{
  constexpr int faces[4][3] = { { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 }, { 0, 2, 1 } };
  for (const auto& [a, b, c] : faces)
  {
    const Face outward{ corners[a], corners[b], corners[c] };
    Face sorted = outward;
    std::sort(sorted.begin(), sorted.end());
    const auto [entry, isNew] = this->Open.try_emplace(sorted, outward);
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
  // All open faces are looked at, which is worthwhile if there are many more of them, or of the
  // vertices that they hold, than the last time.
  const std::size_t usual = this->FacesKept + 20000;
  if (this->Faces.size() > 2 * usual ||
      static_cast<std::size_t>(this->Vertices - this->ClosedAt) > usual)
  {
    this->close(block.finalized, block);
    this->FacesKept = this->Faces.size();
    this->ClosedAt = this->Vertices;
  }
  block.finalized = this->Final;
}

/** Appends the faces that no later cell has, in the order of their vertices. */
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
