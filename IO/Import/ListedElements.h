// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"
#include "IO/External/ExternalSort.h"
#include "IO/Import/ElementSides.h"
#include "IO/Import/FileNumbers.h"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace smg
{

/**
 * Elements that lists of a file name by their numbers, before or after the elements themselves.
 * Elements and entries of lists are written to scratch files as they come; finish() sorts the
 * entries, and passes each one with its element: a sort of the entries, a pass over the elements.
 */
class ListedElements
{
public:
  /** The most corners of an element. */
  static constexpr std::size_t MostCorners = 8;
  /** An entry that means the element itself, not one of its sides. */
  static constexpr std::uint32_t Whole = UINT32_MAX;

  explicit ListedElements(Workspace& workspace)
    : Space(workspace)
    , Elements(workspace)
  {
  }

  /** Adds an element by its corners, as numbers of the file. The numbers of the elements ascend.
   * `kind`: what finish() is to tell of it. Throws MeshError if a corner has more than 32 bits. */
  void add(std::uint32_t number, ElementKind kind, std::span<const std::int64_t> corners);
  /** Adds an entry: the element of this number, or one of its sides, is in a list. */
  void put(std::uint32_t number, std::uint32_t list, std::uint32_t side = Whole);

  /** An entry with its element. */
  struct Found
  {
    std::uint32_t element, list, side;
    ElementKind kind;
    std::span<const std::int64_t> corners;
  };
  /** Passes the entries to `take`, by ascending numbers of elements. Returns the number of those
   * whose elements do not exist. To be called once. */
  template <class Take>
  std::int64_t finish(Take&& take)
  {
    if (!this->Entries)
    {
      return 0;
    }
    this->Elements.close();
    this->Entries->sort();
    RecordFile<std::uint32_t>::Reader reader(this->Elements);
    std::int64_t unknown = 0;
    Entry entry{};
    Element element{};
    bool has = this->Entries->next(entry);
    while (has && element.next(reader))
    {
      for (; has && entry.element <= element.number; has = this->Entries->next(entry))
      {
        if (entry.element < element.number)
        {
          ++unknown;
          continue;
        }
        take(Found{ entry.element, entry.list, entry.side, element.kind,
          std::span(element.corners).first(element.count) });
      }
    }
    for (; has; has = this->Entries->next(entry))
    {
      ++unknown;
    }
    this->Entries.reset();
    this->Elements = RecordFile<std::uint32_t>(this->Space);
    return unknown;
  }

private:
  struct Entry
  {
    std::uint32_t element, list, side;
    auto operator<=>(const Entry&) const = default;
  };

  struct Element
  {
    std::uint32_t number;
    ElementKind kind;
    std::size_t count;
    std::array<std::int64_t, MostCorners> corners;

    bool next(RecordFile<std::uint32_t>::Reader& reader);
  };

  Workspace& Space;
  RecordFile<std::uint32_t> Elements; ///< of each its number, kind and count, and corners
  std::optional<ExternalSort<Entry>> Entries;
};

/** The same of nodes, as members of lists of their numbers. */
class ListedNodes
{
public:
  explicit ListedNodes(Workspace& workspace)
    : Nodes(workspace)
    , Lists(workspace)
  {
  }

  /** Adds an entry: the node of this number, from 1 on, is in a list. */
  void put(std::int64_t number, std::uint32_t list)
  {
    this->Nodes.put(placeOf(number));
    this->Lists.put(list);
  }
  /** What FileNumbers::find() takes for a number from 1 on; others become that of no node. */
  static std::uint32_t placeOf(std::int64_t number)
  {
    return number < 1 || number >= std::int64_t(NoIndex) ? NoIndex - 1
                                                         : static_cast<std::uint32_t>(number - 1);
  }

  /** Passes the entries, the number of the node and the list, to `take`, in their order. Returns
   * the number of those whose nodes do not exist. */
  template <class Take>
  std::int64_t finish(FileNumbers& numbers, Take&& take)
  {
    this->Nodes.close();
    this->Lists.close();
    RecordFile<std::uint32_t>::Reader nodes(this->Nodes), lists(this->Lists);
    std::int64_t unknown = 0;
    numbers.find(this->Nodes,
      [&](std::uint32_t place)
      {
        std::uint32_t node = 0, list = 0;
        nodes.next(node);
        lists.next(list);
        place == NoIndex ? void(++unknown) : take(std::int64_t(node) + 1, list);
      });
    return unknown;
  }

private:
  RecordFile<std::uint32_t> Nodes, Lists;
};

} // namespace smg
