// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/PageCache.h"

#include "smg/Error.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace smg
{

PageCache::PageCache(VertexPages& pages, Workspace& workspace, std::int64_t bytes)
  : Pages(pages)
{
  if (bytes < minBytes(pages))
  {
    throw Error("The order of the mesh needs a page cache of " +
                std::to_string((minBytes(pages) >> 20) + 1) + " MiB, for which there are only " +
                std::to_string(std::max<std::int64_t>(bytes, 0) >> 20) +
                " MiB: raise the memory limit.");
  }
  const std::int64_t units =
    std::min<std::int64_t>(bytes / std::int64_t(Unit), std::int64_t(None) - 1);
  this->Table = Buffer(workspace.pool(), std::size_t(pages.pages()) * sizeof(std::uint32_t));
  std::fill_n(this->table(), pages.pages(), None);
  this->Ring = Buffer(workspace.pool(), std::size_t(units) * Unit);
  this->Units = static_cast<std::uint32_t>(units);
  this->RoomEnd = this->Units;
}

std::int64_t PageCache::minBytes(const VertexPages& pages)
{
  // For any position of the pinned page, there is room for another before or after it.
  return 3 * frameUnits(pages.largestPage()) * std::int64_t(Unit);
}

std::int64_t PageCache::maxBytes(const VertexPages& pages)
{
  // A page that was loaded with its adjacency only may leave a hole.
  return std::max(minBytes(pages),
    pages.allBytes() + pages.allAdjacencyBytes() + 4 * std::int64_t(Unit) * pages.pages());
}

PageCache::Frame& PageCache::load(std::uint32_t page, bool whole)
{
  if (const std::uint32_t at = this->table()[page]; at != None)
  {
    this->drop(this->frame(at));
  }
  const std::size_t bytes = whole ? this->Pages.bytes(page) : this->Pages.adjacencyBytes(page);
  const auto units = static_cast<std::uint32_t>(frameUnits(bytes));
  this->makeRoom(units);
  Frame& frame = this->frame(this->RoomBegin);
  this->Pages.read(page, { reinterpret_cast<std::byte*>(&frame) + Unit, bytes });
  ++this->Loads;
  frame = { page, units, static_cast<std::uint32_t>(this->Pages.adjacencyBytes(page)), whole, false,
    true };
  this->table()[page] = this->RoomBegin;
  this->RoomBegin += units;
  return frame;
}

void PageCache::makeRoom(std::uint32_t units)
{
  while (this->RoomEnd - this->RoomBegin < units)
  {
    if (this->RoomEnd == this->Units)
    {
      this->leaveHole();
      this->RoomBegin = this->RoomEnd = 0;
      continue;
    }
    Frame& next = this->frame(this->RoomEnd);
    const std::uint32_t size = next.units;
    if (next.page != None && next.page == this->Pinned)
    {
      this->leaveHole();
      this->RoomBegin = this->RoomEnd + size;
    }
    else if (next.page != None && next.wanted)
    {
      next.wanted = false;
      this->table()[next.page] = this->RoomBegin;
      std::memmove(&this->frame(this->RoomBegin), &next, size * Unit);
      this->RoomBegin += size;
    }
    else if (next.page != None)
    {
      this->drop(next);
    }
    this->RoomEnd += size;
  }
}

void PageCache::leaveHole()
{
  if (this->RoomBegin < this->RoomEnd)
  {
    this->frame(
      this->RoomBegin) = { None, this->RoomEnd - this->RoomBegin, 0, false, false, false };
  }
}

void PageCache::drop(Frame& frame)
{
  if (frame.changed)
  {
    this->Pages.writePlaces(
      frame.page, { reinterpret_cast<std::byte*>(&frame) + Unit, this->Pages.bytes(frame.page) });
  }
  this->table()[frame.page] = None;
  frame.page = None;
}

} // namespace smg
