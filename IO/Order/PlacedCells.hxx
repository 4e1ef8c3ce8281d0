// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Relabelling.h"

#include <optional>

namespace smg
{

/** Reads the number of the element of each cell. */
class ElementReader
{
public:
  explicit ElementReader(const RawMesh& mesh)
  {
    if (mesh.elements.size() > 0)
    {
      this->Numbers.emplace(mesh.elements);
    }
  }

  /** The element of the next cell. */
  std::uint32_t next()
  {
    std::uint32_t element = this->Cell++;
    if (this->Numbers)
    {
      this->Numbers->next(element);
    }
    return element;
  }

private:
  std::optional<RecordFile<std::uint32_t>::Reader> Numbers;
  std::uint32_t Cell = 0;
};

/** Says the place of each vertex of the order to `places`. */
void putPlaces(const OrderedVertices& order, Relabelling& places);

template <class Take>
void placeCells(
  const RawMesh& mesh, const OrderedVertices& order, Workspace& workspace, Take&& take)
{
  // Half of what is free for the table; sorting wants the other half.
  Relabelling places(workspace, mesh.vertices, workspace.available() / 2);
  putPlaces(order, places);
  ElementReader elements(mesh);
  places.apply(mesh.corners, static_cast<std::size_t>(cornersOf(mesh.cellType)),
    [&](std::span<const std::uint32_t> corners) { take(corners, elements.next()); });
}

} // namespace smg
