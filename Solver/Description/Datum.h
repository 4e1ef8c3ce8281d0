// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Description/Where.h"

#include <concepts>
#include <initializer_list>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace smg
{

/** The coordinates of the vertex, for three columns. */
struct Position
{
};

/** Numbers, the name of a column of the mesh, or the position. */
class DataValue
{
public:
  DataValue(double number)
    : What(std::vector{ number })
  {
  }
  DataValue(std::initializer_list<double> numbers)
    : What(std::vector(numbers))
  {
  }
  DataValue(std::vector<double> numbers)
    : What(std::move(numbers))
  {
  }
  DataValue(std::string column)
    : What(std::move(column))
  {
  }
  DataValue(const char* column)
    : What(std::string(column))
  {
  }
  DataValue(Position position)
    : What(position)
  {
  }

  /** The numbers; null for other values. */
  const std::vector<double>* numbers() const
  {
    return std::get_if<std::vector<double>>(&this->What);
  }
  /** The name of the column; null for other values. */
  const std::string* column() const { return std::get_if<std::string>(&this->What); }
  bool isPosition() const { return std::holds_alternative<Position>(this->What); }

private:
  std::variant<std::vector<double>, std::string, Position> What;
};

/** A value in a part of the mesh. */
struct PlacedValue
{
  Where where;
  DataValue value;
};

/** A datum of a problem, piecewise: the last of the entries that apply at a place counts. Without
 * entries, the datum is not given. */
struct Datum
{
  std::vector<PlacedValue> entries;

  Datum() = default;
  /** The value everywhere. */
  template <std::convertible_to<DataValue> Value>
  Datum(Value&& value)
    : entries{ { Everywhere{}, std::forward<Value>(value) } }
  {
  }
  Datum(std::initializer_list<PlacedValue> placed)
    : entries(placed)
  {
  }

  bool isGiven() const { return !this->entries.empty(); }
};

} // namespace smg
