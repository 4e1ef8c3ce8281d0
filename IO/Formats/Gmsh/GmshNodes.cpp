// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Gmsh/GmshNodes.h"

#include "IO/Import/RawMeshBuilder.h"

#include <algorithm>
#include <string>

namespace smg
{

void GmshNodes::addOther(std::int64_t tag)
{
  if (this->Count == 0)
  {
    this->First = tag;
    ++this->Count;
    return;
  }
  if (!this->Tags)
  {
    this->Tags.emplace(this->Space, this->Space.available() / 2);
    for (std::int64_t vertex = 0; vertex < this->Count; ++vertex)
    {
      this->Tags->put({ this->First + vertex, vertex });
    }
    this->Least = this->First;
    this->Largest = this->First + (this->Count - 1);
  }
  this->Tags->put({ tag, this->Count++ });
  this->Least = std::min(this->Least, tag);
  this->Largest = std::max(this->Largest, tag);
}

void GmshNodes::finish()
{
  if (!this->Tags)
  {
    this->Range = static_cast<std::uint64_t>(this->Count);
    return;
  }
  this->First = this->Least;
  const std::uint64_t distance = this->distance(this->Largest);
  if (distance >= NoIndex - 1)
  {
    throw MeshError("the tags of the nodes are from " + std::to_string(this->Least) + " to " +
                    std::to_string(this->Largest) +
                    ", which is more than 4294967294 numbers: renumber the nodes first");
  }
  this->Range = distance + 1;
  this->number();
}

void GmshNodes::number()
{
  this->Tags->sort();
  this->Numbers.emplace(
    this->Space, static_cast<std::int64_t>(this->Range), this->Space.available() / 2);
  Tag before{ this->Least, -1 };
  for (Tag next{}; this->Tags->next(next); before = next)
  {
    if (next.tag == before.tag && before.vertex >= 0)
    {
      throw MeshError("there are two nodes " + std::to_string(next.tag));
    }
    this->Numbers->put(static_cast<std::uint32_t>(this->distance(next.tag)),
      static_cast<std::uint32_t>(next.vertex));
  }
  this->Numbers->close();
  this->Tags.reset();
}

} // namespace smg
