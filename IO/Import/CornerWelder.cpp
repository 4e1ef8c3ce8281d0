// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/CornerWelder.h"

#include <bit>
#include <cmath>
#include <utility>

namespace smg
{

CornerWelder::CornerWelder(RawMeshBuilder& builder)
  : Builder(builder)
  , Memory(builder.workspace().available())
  , Corners(builder.workspace(), this->Memory * 3 / 10)
  , Firsts(builder.workspace(), this->Memory / 10)
  , Members(builder.workspace(), this->Memory * 3 / 10)
{
}

void CornerWelder::corner(Point point)
{
  Corner corner;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!std::isfinite(point[axis]))
    {
      throw MeshError("a coordinate is not finite");
    }
    corner.bits[axis] = std::bit_cast<std::uint32_t>(point[axis] + 0.0f); // -0 becomes 0
  }
  corner.number = { static_cast<std::uint32_t>(this->CornerCount >> 32),
    static_cast<std::uint32_t>(this->CornerCount) };
  ++this->CornerCount;
  this->Corners.put(corner);
}

void CornerWelder::makeGroups()
{
  this->Corners.sort();
  std::array<std::uint32_t, 3> bits{};
  for (Corner corner; this->Corners.next(corner);)
  {
    if (this->Groups == 0 || corner.bits != bits)
    {
      if (this->Groups == NoIndex - 1)
      {
        throw MeshError("the mesh has more than 4294967294 vertices, which are too many");
      }
      bits = corner.bits;
      this->Firsts.put({ corner.number, this->Groups++, bits });
    }
    this->Members.put({ corner.number, this->Groups - 1 });
  }
}

void CornerWelder::makeVertices()
{
  this->makeGroups();
  this->Firsts.sort();
  Relabelling vertices(this->Builder.workspace(), this->Groups, this->Memory / 2);
  for (First first; this->Firsts.next(first);)
  {
    vertices.put(first.group, static_cast<std::uint32_t>(this->Builder.vertices()));
    this->Builder.vertex(std::bit_cast<float>(first.bits[0]), std::bit_cast<float>(first.bits[1]),
      std::bit_cast<float>(first.bits[2]));
  }
  this->Builder.relabelCorners(std::move(vertices));
  this->Members.sort();
}

} // namespace smg
