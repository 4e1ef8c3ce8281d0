// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Describe.h"

#include <span>

namespace smg
{

/** The ranges and tags of a column that comes in parts. */
class ColumnSummary
{
public:
  explicit ColumnSummary(const ColumnSpec& spec);

  /** Adds the next tuples, of a column with this specification. */
  void add(const Column& column);

  const MeshDescription::Column& result() const { return this->Result; }

private:
  template <class T>
  void addValues(std::span<const T> values);
  template <class T>
  void count(std::span<const T> values);

  MeshDescription::Column Result;
  bool HasTags; ///< it may: its values are few so far
};

} // namespace smg
