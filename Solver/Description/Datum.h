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

/** The vertex's own coordinates, for three columns. */
struct Position
{
};

/** Numbers, the column of the mesh of a name, or the position. */
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

  /** The numbers; null: it is something else. */
  const std::vector<double>* numbers() const
  {
    return std::get_if<std::vector<double>>(&this->What);
  }
  /** The name of the column; null: it is something else. */
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

/**
 * A datum of a problem, part by part: of the entries that hold somewhere the last one counts. One
 * without entries is not given.
 */
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
