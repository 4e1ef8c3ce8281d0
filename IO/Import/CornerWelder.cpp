// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/CornerWelder.h"

#include <bit>
#include <cmath>
#include <utility>

namespace smg
{

template <class T>
CornerWelder<T>::CornerWelder(RawMeshBuilder& builder)
  : Builder(builder)
  , Memory(builder.workspace().available())
  , Corners(builder.workspace(), this->Memory * 3 / 10)
  , Firsts(builder.workspace(), this->Memory / 10)
  , Members(builder.workspace(), this->Memory * 3 / 10)
{
}

template <class T>
void CornerWelder<T>::corner(Point point)
{
  for (T& coordinate : point)
  {
    if (!std::isfinite(coordinate))
    {
      throw MeshError("a coordinate is not finite");
    }
    coordinate += T(0); // -0 becomes 0
  }
  Corner corner;
  corner.bits = std::bit_cast<Bits>(point);
  corner.number = { static_cast<std::uint32_t>(this->CornerCount >> 32),
    static_cast<std::uint32_t>(this->CornerCount) };
  ++this->CornerCount;
  this->Corners.put(corner);
}

template <class T>
void CornerWelder<T>::makeGroups()
{
  this->Corners.sort();
  Bits bits{};
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

template <class T>
void CornerWelder<T>::makeVertices()
{
  this->makeGroups();
  this->Firsts.sort();
  Relabelling vertices(this->Builder.workspace(), this->Groups, this->Memory / 2);
  for (First first; this->Firsts.next(first);)
  {
    vertices.put(first.group, static_cast<std::uint32_t>(this->Builder.vertices()));
    const Point point = std::bit_cast<Point>(first.bits);
    this->Builder.vertex(point[0], point[1], point[2]);
  }
  this->Builder.relabelCorners(std::move(vertices));
  this->Members.sort();
}

template class CornerWelder<float>;
template class CornerWelder<double>;

} // namespace smg
