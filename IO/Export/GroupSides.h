// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/GroupElements.h"
#include "IO/Export/MeshFileWriter.h"
#include "IO/Export/PlacedColumns.h"
#include "IO/External/ExternalSort.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/**
 * The facets in groups as sides of the elements of a file, for formats that name them so
 * (GroupForm::Sides). Sorted by the elements in the order of the file, and merged with these as
 * they come: one reading of the columns, and a sort of the facets in groups, out of core.
 */
class GroupSides
{
public:
  /** `info` and `columns` are those of the writer; the numbers of its elements count as placed. */
  GroupSides(const MeshFileInfo& info, PlacedColumns& columns, Workspace& space);

  /** A side of an element: of a tetrahedron the face opposite to corner `number`, of a polygon the
   * edge from corner `number` to the next. */
  struct Side
  {
    std::size_t number;
    GroupSet set;
  };
  /** Passes each element of the next chunk, with polygons of more than `most` corners as the
   * triangles of their fans: its corners, its index in the chunk, and its sides in groups. */
  template <class Take>
  void forEach(const ElementChunk& chunk, std::size_t most, Take&& take)
  {
    std::size_t last = SIZE_MAX;
    chunk.forEachUpTo(most,
      [&](std::span<const std::int64_t> corners, std::size_t element)
      {
        if (element != last)
        {
          this->collect(this->numberOf(chunk, element));
          last = element;
        }
        take(corners, element, this->sidesOf(corners));
      });
  }

  /** After the last chunk: how often a facet is in a group that is the side of no element, as the
   * diagonal of a quadrilateral. */
  std::int64_t elsewhere();
  /** A sentence on that, if there are any. */
  void note(WriteNotes& notes);

private:
  using Corners =
    std::array<std::int64_t, 3>; ///< ascending; of an edge the third is the greatest number
  struct Facet
  {
    std::int64_t element;
    Corners corners;
    std::int64_t set;
    auto operator<=>(const Facet&) const = default;
  };
  struct Found
  {
    Corners corners;
    GroupSet set;
    bool isSide;
  };

  static Corners sorted(std::span<const std::int64_t> vertices);
  std::int64_t numberOf(const ElementChunk& chunk, std::size_t element) const;
  void collect(std::int64_t element);
  void dropCollected();
  std::span<const Side> sidesOf(std::span<const std::int64_t> corners);

  CellType Cells;
  std::ptrdiff_t Numbers; ///< column; -1: elements count on
  std::optional<ExternalSort<Facet>> Facets;
  Facet Next{};
  bool HasNext = false;
  std::int64_t Element = -1;    ///< of those collected
  std::vector<Found> Collected; ///< facets of the current element
  std::vector<Side> Sides;
  std::int64_t Elsewhere = 0;
};

} // namespace smg
