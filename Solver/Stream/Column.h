// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/ScalarType.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** The name, scalar type and number of components of a column. */
struct ColumnSpec
{
  std::string name;
  ScalarType type = ScalarType::Float64;
  int components = 1;

  std::size_t tupleBytes() const { return sizeOf(this->type) * this->components; }
  bool operator==(const ColumnSpec&) const = default;
};

/** A column of values, tuples one after the other: an attribute of vertices or of cells. */
struct Column
{
  ColumnSpec spec;
  std::vector<std::byte> bytes;

  std::size_t tuples() const { return this->bytes.size() / this->spec.tupleBytes(); }
  void resize(std::size_t tuples) { this->bytes.resize(tuples * this->spec.tupleBytes()); }

  /** The values as T, which must be the type of the column. */
  template <class T>
  std::span<T> as()
  {
    assert(scalarTypeOf<T>() == this->spec.type);
    return { reinterpret_cast<T*>(this->bytes.data()), this->bytes.size() / sizeof(T) };
  }
  template <class T>
  std::span<const T> as() const
  {
    assert(scalarTypeOf<T>() == this->spec.type);
    return { reinterpret_cast<const T*>(this->bytes.data()), this->bytes.size() / sizeof(T) };
  }

  /** Component `component` of tuple `tuple`, converted to double. */
  double value(std::size_t tuple, int component = 0) const
  {
    const std::byte* p =
      this->bytes.data() + tuple * this->spec.tupleBytes() + component * sizeOf(this->spec.type);
    return dispatch(this->spec.type,
      [p]<class T>(T) { return static_cast<double>(*reinterpret_cast<const T*>(p)); });
  }
};

/** The index of the first column equal to `spec`; -1 if there is none. */
inline std::ptrdiff_t findColumn(const std::vector<ColumnSpec>& specs, const ColumnSpec& spec)
{
  const auto found = std::ranges::find(specs, spec);
  return found == specs.end() ? -1 : found - specs.begin();
}
inline std::ptrdiff_t findColumn(const std::vector<Column>& columns, const ColumnSpec& spec)
{
  const auto found = std::ranges::find(columns, spec, &Column::spec);
  return found == columns.end() ? -1 : found - columns.begin();
}

} // namespace smg
