// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/GroupSides.h"

#include "Solver/Core/Text.h"

namespace smg
{

GroupSides::GroupSides(const MeshFileInfo& info, PlacedColumns& columns, Workspace& space)
  : Cells(info.cellType)
  , Numbers(columns.integerOfElements({ OriginalCellIdName }))
{
  if (!info.groups || info.groups->memberships(GroupOf::Facets) == 0)
  {
    return;
  }
  this->Facets.emplace(space, space.available() / 4);
  info.groups->forEach(GroupOf::Facets,
    [this](std::span<const std::int64_t> vertices, GroupSet set, std::int64_t element) {
      this->Facets->put({ element, sorted(vertices), set });
    });
  this->Facets->sort();
  this->HasNext = this->Facets->next(this->Next);
}

GroupSides::Corners GroupSides::sorted(std::span<const std::int64_t> vertices)
{
  Corners corners{ vertices[0], vertices[1], vertices.size() > 2 ? vertices[2] : INT64_MAX };
  std::ranges::sort(corners);
  return corners;
}

std::int64_t GroupSides::numberOf(const ElementChunk& chunk, std::size_t element) const
{
  return this->Numbers < 0
           ? chunk.first + static_cast<std::int64_t>(element)
           : chunk.columns[static_cast<std::size_t>(this->Numbers)].as<std::int64_t>()[element];
}

void GroupSides::dropCollected()
{
  this->Elsewhere += std::ranges::count(this->Collected, false, &Found::isSide);
  this->Collected.clear();
}

/** Of an element that became several, as a hexahedron its tetrahedra, all have its number. */
void GroupSides::collect(std::int64_t element)
{
  if (element == this->Element)
  {
    return;
  }
  this->dropCollected();
  this->Element = element;
  for (; this->HasNext && this->Next.element <= element;
       this->HasNext = this->Facets->next(this->Next))
  {
    this->Next.element < element ? void(++this->Elsewhere)
                                 : this->Collected.push_back({ this->Next.corners,
                                     static_cast<GroupSet>(this->Next.set), false });
  }
}

std::span<const GroupSides::Side> GroupSides::sidesOf(std::span<const std::int64_t> corners)
{
  this->Sides.clear();
  const std::size_t count = corners.size();
  for (std::size_t side = 0; !this->Collected.empty() && side < count; ++side)
  {
    std::array<std::int64_t, 3> others{ corners[side], corners[(side + 1) % count], 0 };
    if (this->Cells == CellType::Tetrahedron)
    {
      others = { corners[(side + 1) % 4], corners[(side + 2) % 4], corners[(side + 3) % 4] };
    }
    const Corners own =
      sorted(std::span(others).first(this->Cells == CellType::Tetrahedron ? 3 : 2));
    for (Found& found : this->Collected)
    {
      // A facet between two parts of one element belongs to the first.
      if (found.corners == own && !found.isSide)
      {
        found.isSide = true;
        this->Sides.push_back({ side, found.set });
      }
    }
  }
  return this->Sides;
}

std::int64_t GroupSides::elsewhere()
{
  this->dropCollected();
  for (; this->HasNext; this->HasNext = this->Facets->next(this->Next))
  {
    ++this->Elsewhere;
  }
  return this->Elsewhere;
}

void GroupSides::note(WriteNotes& notes)
{
  if (const std::int64_t count = this->elsewhere(); count > 0)
  {
    notes.push_back(counted(count, "facet of groups is a diagonal of a polygon",
                      "facets of groups are diagonals of polygons") +
                    ", which is the side of no element, and left out.");
  }
}

} // namespace smg
