// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/PageCache.h"

#include "smg/Error.h"

#include <algorithm>
#include <cstring>
#include <string>

// A cache of pages in a ring of frames of different sizes: CLOCK without gaps.
//
// Invariant: outside of the room [RoomBegin, RoomEnd) the ring is a sequence of frames and holes
// without gaps, so the hand always stands at the header of one. The hand makes room by passing
// frames: one that was used since the last round moves up to the beginning of the room, another one
// goes, so that the room grows in one piece. A page that goes writes its places back if they were
// changed, 4 bytes for each vertex; its adjacency never changes.
//
// Only the owner of a search changes pages, so nothing here is locked; loaded() may be called by
// several threads while nothing else uses the cache.

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
  // Places in the ring have 32 bits, in units of 16 bytes: up to 64 GiB.
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
  // Wherever the pinned page is, there is room for another one before or after it.
  return 3 * frameUnits(pages.largestPage()) * std::int64_t(Unit);
}

std::int64_t PageCache::maxBytes(const VertexPages& pages)
{
  // A page that was loaded with its adjacency only, and later as a whole, may leave a hole; and
  // each frame has a header and is rounded up.
  return std::max(minBytes(pages),
    pages.allBytes() + pages.allAdjacencyBytes() + 4 * std::int64_t(Unit) * pages.pages());
}

PageCache::Frame& PageCache::load(std::uint32_t page, bool whole)
{
  // Only the adjacency is there, and the whole is wanted: the page is loaded again. Its old frame
  // becomes a hole.
  if (const std::uint32_t at = this->table()[page]; at != None)
  {
    this->drop(this->frame(at));
  }
  const std::size_t bytes = whole ? this->Pages.bytes(page) : this->Pages.adjacencyBytes(page);
  const auto units = static_cast<std::uint32_t>(frameUnits(bytes));
  this->makeRoom(units);
  // The header is written after the bytes, so a failed read leaves no page in the table.
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
    // The end of the ring: what is left of the room stays as a hole, and the hand begins again at
    // the front.
    if (this->RoomEnd == this->Units)
    {
      this->leaveHole();
      this->RoomBegin = this->RoomEnd = 0;
      continue;
    }
    Frame& next = this->frame(this->RoomEnd);
    const std::uint32_t size = next.units;
    // The pinned page must not move, since views of it are in use. The room before it is given up.
    if (next.page != None && next.page == this->Pinned)
    {
      this->leaveHole();
      this->RoomBegin = this->RoomEnd + size;
    }
    // A second chance: it moves, and goes the next time unless it is used until then.
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

/** Marks the room as a hole, so that the sequence of headers has no gap. */
void PageCache::leaveHole()
{
  if (this->RoomBegin < this->RoomEnd)
  {
    this->frame(
      this->RoomBegin) = { None, this->RoomEnd - this->RoomBegin, 0, false, false, false };
  }
}

/** Removes a page from the cache. Its frame remains as a hole until the hand passes it. */
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
