// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/MeshColumns.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

namespace smg
{

/** Tests a column of one number for a value, or for values other than 0. */
struct ColumnTest
{
  NamedColumn column;
  std::optional<double> value; ///< none: any value other than 0

  /** Sets `selected` to 1 where the rows of `values` from `first` on have the value, else to 0.
   * Returns the index of the first NaN in a mask, or the size of `selected`. */
  std::size_t apply(const Column& values, std::size_t first, std::span<std::uint8_t> selected) const
  {
    std::size_t valid = selected.size();
    dispatch(values.spec.type,
      [&]<class T>(T)
      {
        const std::span<const T> numbers = values.as<T>().subspan(first);
        for (std::size_t i = 0; i < selected.size(); ++i)
        {
          const auto number = static_cast<double>(numbers[i]);
          selected[i] = (this->value ? number == this->valueAs<T>() : number != 0.0) ? 1 : 0;
          valid = !this->value && std::isnan(number) ? std::min(valid, i) : valid;
        }
      });
    return valid;
  }

  /** The value in the precision of T: 0.1 in single precision is another number. */
  template <class T>
  double valueAs() const
  {
    return std::is_same_v<T, float> ? static_cast<double>(static_cast<float>(*this->value))
                                    : *this->value;
  }

  /** The predicate of a selected item, for messages. */
  std::string predicate() const
  {
    return (this->value ? "has this tag in '" : "has a value other than 0 in '") +
           this->column.name + "'";
  }
};

} // namespace smg
