// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"
#include "smg/Column.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/** Columns of vertices or elements that come with these, but follow them in a file, one after the
 * other: kept in scratch files. */
class KeptColumns
{
public:
  /** `places`: in the columns of the chunks. */
  KeptColumns(Workspace& workspace, const std::vector<ColumnSpec>& specs,
    const std::vector<std::size_t>& places)
  {
    // Their buffers share what a few would have.
    const std::int64_t share =
      workspace.available() / 16 / std::max<std::int64_t>(std::ssize(places), 1);
    for (const std::size_t place : places)
    {
      this->Kept.push_back({ specs[place], place, BucketFile(workspace, 1, share) });
    }
  }

  std::size_t size() const { return this->Kept.size(); }
  const ColumnSpec& spec(std::size_t column) const { return this->Kept[column].spec; }

  /** Appends a tuple of the columns of a chunk. */
  void append(const std::vector<Column>& columns, std::size_t tuple)
  {
    for (KeptColumn& kept : this->Kept)
    {
      const std::size_t bytes = kept.spec.tupleBytes();
      kept.tuples.append(0, std::span(columns[kept.place].bytes).subspan(tuple * bytes, bytes));
    }
  }

  /** After the last tuple: passes the tuples of a column, some at once and in order, to `take` as a
   * list of one column. */
  template <class Take>
  void forEach(std::size_t column, Take&& take)
  {
    constexpr std::size_t AtOnce = std::size_t(64) << 10; // bytes
    KeptColumn& kept = this->Kept[column];
    kept.tuples.close();
    BucketFile::Reader reader(kept.tuples);
    const std::size_t tupleBytes = kept.spec.tupleBytes();
    std::vector<Column> some{ { kept.spec, {} } };
    for (auto bytes = reader.next(tupleBytes, std::max(AtOnce, tupleBytes)); !bytes.empty();
         bytes = reader.next(tupleBytes, std::max(AtOnce, tupleBytes)))
    {
      some[0].bytes.assign(bytes.begin(), bytes.end());
      take(std::as_const(some));
    }
  }

private:
  struct KeptColumn
  {
    ColumnSpec spec;
    std::size_t place;
    BucketFile tuples;
  };

  std::vector<KeptColumn> Kept;
};

} // namespace smg
