// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"

#include <cstdint>
#include <limits>
#include <optional>

namespace smg
{

/**
 * The tags of the nodes, to which elements refer: any numbers, usually 1, 2, 3 ... Consecutive tags
 * are not stored; others are sorted out of core, and the elements have tags as corners until a
 * Relabelling replaces these.
 */
class GmshNodes
{
public:
  explicit GmshNodes(Workspace& workspace)
    : Space(workspace)
  {
  }

  /** Adds the tag of the next node. */
  void add(std::int64_t tag)
  {
    if (!this->Tags && tag >= this->First &&
        this->distance(tag) == static_cast<std::uint64_t>(this->Count))
    {
      ++this->Count;
      return;
    }
    this->addOther(tag);
  }
  std::int64_t count() const { return this->Count; }

  /** To be called after the last node. Throws MeshError if two nodes have the same tag, or the
   * range of the tags exceeds 32 bits. */
  void finish();

  /** The number of the corner with this tag; -1 if no node can have the tag. */
  std::int64_t corner(std::int64_t tag) const
  {
    const std::uint64_t place = this->distance(tag);
    return place < this->Range ? static_cast<std::int64_t>(place) : -1;
  }

  /** Returns the vertices of the corners; nothing if corners are vertices. */
  std::optional<Relabelling> takeNumbers() { return std::move(this->Numbers); }

private:
  struct Tag
  {
    std::int64_t tag;
    std::int64_t vertex;
    bool operator<(const Tag& other) const
    {
      return this->tag != other.tag ? this->tag < other.tag : this->vertex < other.vertex;
    }
  };

  /** From the first tag, without overflow. */
  std::uint64_t distance(std::int64_t tag) const
  {
    return static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(this->First);
  }
  void addOther(std::int64_t tag);
  void number();

  Workspace& Space;
  std::int64_t Count = 0;
  std::int64_t First = 1; ///< tag of the first node; after finish() the least tag
  std::int64_t Least = std::numeric_limits<std::int64_t>::max();
  std::int64_t Largest = std::numeric_limits<std::int64_t>::min();
  std::uint64_t Range = 0; ///< tags from First to the largest one
  std::optional<ExternalSort<Tag>> Tags;
  std::optional<Relabelling> Numbers;
};

} // namespace smg
