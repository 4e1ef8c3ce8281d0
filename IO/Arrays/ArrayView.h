// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Error.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace smg
{

/** The error of an argument that a program has given: a text, an option, or the shape, the type or
 * a number of an array. */
class SMG_EXPORT ArgumentError : public Error
{
public:
  using Error::Error;
};

/** A table of numbers that belongs to somebody else. */
struct ArrayView
{
  const void* data = nullptr;
  ScalarType type = ScalarType::Float64;
  std::int64_t rows = 0, columns = 1;
  std::int64_t rowStride = 0, columnStride = 0; ///< bytes; perhaps negative

  /** The number at a place, which need not be aligned. */
  const std::byte* at(std::int64_t row, std::int64_t column) const
  {
    return static_cast<const std::byte*>(this->data) + row * this->rowStride +
           column * this->columnStride;
  }
  /** The number at a place as a T. */
  template <class T>
  T value(std::int64_t row, std::int64_t column) const
  {
    return dispatch(this->type,
      [p = this->at(row, column)]<class Own>(Own number)
      {
        std::memcpy(&number, p, sizeof number);
        return static_cast<T>(number);
      });
  }
  /** Copies the numbers of a row, one after the other. */
  void copyRow(std::int64_t row, std::byte* to) const
  {
    const std::size_t size = sizeOf(this->type);
    if (this->columnStride == static_cast<std::int64_t>(size))
    {
      std::memcpy(to, this->at(row, 0), size * static_cast<std::size_t>(this->columns));
      return;
    }
    for (std::int64_t column = 0; column < this->columns; ++column, to += size)
    {
      std::memcpy(to, this->at(row, column), size);
    }
  }
  bool isInteger() const
  {
    return this->type != ScalarType::Float32 && this->type != ScalarType::Float64;
  }
};

} // namespace smg
