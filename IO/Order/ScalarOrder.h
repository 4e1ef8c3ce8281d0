// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/Order/OrderedVertices.h"
#include "IO/Order/VertexPages.h"

#include <cstring>
#include <span>

namespace smg
{

/** Calls `take` with each page of the file: its number and all its bytes, in a buffer of the pool.
 */
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
    take(page, std::span<const std::byte>(buffer.bytes().first(bytes)));
  }
}

/**
 * Sorts paged vertices by a value each, ties by their numbers in the file. `value` is called with
 * the page, its bytes and the number of the vertex in the page.
 */
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
    [&](std::int64_t page, std::span<const std::byte> bytes)
    {
      const auto ids = pages.ids(page, bytes);
      const auto positions = pages.positions(page, bytes);
      for (std::uint32_t i = 0; i < ids.size(); ++i)
      {
        Entry entry{ value(page, bytes, i), { {}, ids[i], NoIndex } };
        std::memcpy(
          entry.vertex.position, positions.data() + i * 3 * sizeof(Real), 3 * sizeof(Real));
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
