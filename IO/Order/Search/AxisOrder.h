// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/Order/Pages/OrderedVertices.h"
#include "IO/Order/Pages/VertexPages.h"

#include <cstring>

namespace smg
{

/** The vertices in the order along the longest side of their bounds; ties by their numbers in the
 * file. */
OrderedVertices axisOrder(VertexPages& pages, Workspace& workspace);

/** Calls `take` with a view of each whole page of the file, in a buffer of the pool. */
template <class Take>
void forEachPage(VertexPages& pages, Workspace& workspace, Take&& take)
{
  Buffer buffer;
  for (std::int64_t page = 0; page < pages.pages(); ++page)
  {
    const std::size_t bytes = pages.bytes(page);
    if (bytes > buffer.capacity())
    {
      buffer = Buffer();
      buffer = Buffer(workspace.pool(), bytes + bytes / 4);
    }
    pages.read(page, buffer.bytes().first(bytes));
    take(pages.view(page, buffer.data()));
  }
}

/** Sorts paged vertices by a value, ties by their numbers in the file. `value` is called with a
 * view of the page and the index of the vertex in the page. */
template <class Real, class Value>
OrderedVertices scalarOrder(VertexPages& pages, Workspace& workspace, Value&& value)
{
  struct Entry
  {
    double value;
    OrderedVertex<Real> vertex;
    bool operator<(const Entry& other) const
    {
      return this->value != other.value ? this->value < other.value
                                        : this->vertex.id < other.vertex.id;
    }
  };
  ExternalSort<Entry> sort(workspace, workspace.available() * 3 / 4);
  forEachPage(pages, workspace,
    [&](const PageView& page)
    {
      for (std::uint32_t i = 0; i < page.vertices(); ++i)
      {
        Entry entry{ value(page, i), { {}, page.ids()[i], NoIndex } };
        std::memcpy(entry.vertex.position, page.position(i, 3 * sizeof(Real)), 3 * sizeof(Real));
        sort.put(entry);
      }
    });
  sort.sort();
  OrderedVertices result(workspace);
  result.doublePositions = pages.doublePositions();
  for (Entry entry; sort.next(entry); ++result.count)
  {
    result.records.put(0, entry.vertex);
  }
  result.records.close();
  return result;
}

} // namespace smg
