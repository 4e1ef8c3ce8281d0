// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Pages/VertexPages.h"
#include "Solver/Memory/Buffer.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace smg
{

/**
 * A cache of pages in a fixed amount of memory. Pages are loaded when they are asked for: only
 * their adjacency, which is what a search reads, or the whole.
 *
 * The memory is a ring of frames of any size. A hand goes around it and makes room: a page that was
 * asked for since the hand came by is spared and moved up to the frame before it, any other one is
 * evicted, so that the room is in one piece (CLOCK without gaps). When a page is evicted, its
 * places are written to the file if they were changed.
 */
class PageCache
{
public:
  /** The pages must be closed and outlive the cache. Throws Error below minBytes(). */
  PageCache(VertexPages& pages, Workspace& workspace, std::int64_t bytes);

  /** The least bytes with which a search works, with any number of loads. */
  static std::int64_t minBytes(const VertexPages& pages);
  /** The bytes with which all pages fit, so that each is loaded once. */
  static std::int64_t maxBytes(const VertexPages& pages);

  /** A page whose adjacency can be read. The view is valid until another page is requested. Throws
   * Error. */
  PageView adjacency(std::uint32_t page)
  {
    const std::uint32_t at = this->table()[page];
    return this->view(at != None ? this->frame(at) : this->load(page, false));
  }
  /** The same if the page is loaded. The view is valid as long as only this function is used; any
   * number of threads may call it at once. */
  std::optional<PageView> loaded(std::uint32_t page) const
  {
    const std::uint32_t at = this->table()[page];
    if (at == None)
    {
      return std::nullopt;
    }
    Frame& frame = this->frame(at);
    if (const std::atomic_ref wanted(frame.wanted); !wanted.load(std::memory_order_relaxed))
    {
      wanted.store(true, std::memory_order_relaxed);
    }
    return this->Pages.view(page, reinterpret_cast<std::byte*>(&frame) + Unit, frame.adjacency);
  }
  /** A page that can be read completely, and whose positions can be modified. */
  PageView whole(std::uint32_t page)
  {
    const std::uint32_t at = this->table()[page];
    return this->view(
      at != None && this->frame(at).whole ? this->frame(at) : this->load(page, true));
  }
  /** Declares that the positions of a page with a valid view were modified. */
  void touch(std::uint32_t page) { this->frame(this->table()[page]).changed = true; }
  /** Keeps the views of this loaded page valid until another page is pinned. */
  void pin(std::uint32_t page) { this->Pinned = page; }
  void unpin() { this->Pinned = None; }

  /** The number of pages read from the file. */
  std::int64_t loads() const { return this->Loads; }
  std::int64_t bytes() const { return std::int64_t(this->Ring.size()); }

private:
  static constexpr std::uint32_t None = 0xffffffffu;

  /** The header of the bytes of a page, or of a hole. */
  struct Frame
  {
    std::uint32_t page; ///< None: a hole
    std::uint32_t units;
    std::uint32_t adjacency; ///< bytes
    bool whole, changed, wanted;
  };
  /** Positions in the ring are counted in units. */
  static constexpr std::size_t Unit = 16;
  static_assert(sizeof(Frame) == Unit);

  static std::int64_t frameUnits(std::size_t bytes)
  {
    return std::int64_t(1 + (bytes + Unit - 1) / Unit);
  }

  std::uint32_t* table() const { return reinterpret_cast<std::uint32_t*>(this->Table.data()); }
  Frame& frame(std::uint32_t at) const
  {
    return *reinterpret_cast<Frame*>(this->Ring.data() + at * Unit);
  }
  PageView view(Frame& frame)
  {
    frame.wanted = true;
    return this->Pages.view(
      frame.page, reinterpret_cast<std::byte*>(&frame) + Unit, frame.adjacency);
  }

  Frame& load(std::uint32_t page, bool whole);
  void makeRoom(std::uint32_t units);
  void leaveHole();
  void drop(Frame& frame);

  VertexPages& Pages;
  Buffer Table; ///< position of the frame of each page; None: not loaded
  Buffer Ring;
  std::uint32_t Units;
  /** The free range made by the hand. Everywhere else, frames and holes are contiguous. */
  std::uint32_t RoomBegin = 0, RoomEnd;
  std::uint32_t Pinned = None;
  std::int64_t Loads = 0;
};

} // namespace smg
