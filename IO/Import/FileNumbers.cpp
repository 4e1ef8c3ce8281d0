// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/FileNumbers.h"

#include "IO/Import/RawMeshBuilder.h"

#include <algorithm>

namespace smg
{

void FileNumbers::addOther(std::int64_t number)
{
  if (this->FromOne && number < 1)
  {
    throw MeshError("the number " + std::to_string(number) + " is not one of " + this->What +
                    ", which count from 1");
  }
  if (this->Count == 0 && !this->FromOne)
  {
    this->First = number;
    ++this->Count;
    return;
  }
  if (!this->Numbers)
  {
    this->Numbers.emplace(this->Space, this->Space.available() / 2);
    for (std::int64_t place = 0; place < this->Count; ++place)
    {
      this->Numbers->put({ this->First + place, place });
    }
    this->Least = this->First;
    this->Largest = std::max(this->First + (this->Count - 1), this->First);
  }
  this->Numbers->put({ number, this->Count++ });
  this->Least = std::min(this->Least, number);
  this->Largest = std::max(this->Largest, number);
}

void FileNumbers::finish()
{
  if (!this->Numbers)
  {
    this->Range = static_cast<std::uint64_t>(this->Count);
    return;
  }
  this->First = this->FromOne ? 1 : this->Least;
  const std::uint64_t distance = this->distance(this->Largest);
  if (distance >= NoIndex - 1)
  {
    throw MeshError("the numbers of the " + this->What + " are from " +
                    std::to_string(this->First) + " to " + std::to_string(this->Largest) +
                    ", which is more than 4294967294 numbers: renumber the " + this->What +
                    " first");
  }
  this->Range = distance + 1;
  this->sort();
}

void FileNumbers::numberCorners(RawMeshBuilder& builder)
{
  if (!this->FromOne)
  {
    builder.numberVertices(this->First, static_cast<std::int64_t>(this->Range));
  }
  if (this->Places)
  {
    builder.relabelCorners(std::move(*this->Places));
  }
}

void FileNumbers::sort()
{
  this->Numbers->sort();
  this->Places.emplace(
    this->Space, static_cast<std::int64_t>(this->Range), this->Space.available() / 2);
  Numbered before{ this->First, -1 };
  for (Numbered next{}; this->Numbers->next(next); before = next)
  {
    if (next.number == before.number && before.place >= 0)
    {
      throw MeshError("there are two " + this->What + ' ' + std::to_string(next.number));
    }
    this->Places->put(static_cast<std::uint32_t>(this->distance(next.number)),
      static_cast<std::uint32_t>(next.place));
  }
  this->Places->close();
  this->Numbers.reset();
}

} // namespace smg
