// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Problem.h"
#include "smg/Region.h"

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

/**
 * An elliptic problem -div(K grad u - q) + s u = f on a mesh, in terms of regions and columns of
 * that mesh; DescribedProblem turns it into a Problem. Defaults: the Laplace equation, one column.
 *
 *     ProblemDescription heat;
 *     heat.conductivity = { { Everywhere{}, 1.0 }, { ColumnTag{ "PhysicalTag", 3 }, 10.0 } };
 *     heat.source = "heating";
 *     heat.dirichlet = { { Region::Sphere{ { 0, 0, 0 }, 0.1 }, 20.0 } };
 *     heat.robin = { { ColumnMask{ "outside" }, 5.0, 4.0 } };
 *
 * Values have `columns` numbers, coefficients one. In a cell, a column of the vertices has the mean
 * value of the corners.
 */
struct ProblemDescription
{
  /** The maximum number of columns of a problem. */
  static constexpr int MostColumns = 64;

  /** (K grad u - q) . n = coefficient * (ambient - u) on a part of the boundary. */
  struct Robin
  {
    Where where;
    Datum coefficient; ///< at least 0
    DataValue ambient;
  };
  /** Adds weight * (u - value), times the lumped area or volume, to the equations of vertices. */
  struct Soft
  {
    Where where;
    Datum weight; ///< at least 0
    DataValue value;
  };

  Weights weights = Weights::Cotangent;
  /** The number of simultaneous right-hand sides, 1 to 64. */
  int columns = 1;
  /** K in the cells: a positive number, the diagonal of a tensor (xx, yy, zz), or a symmetric
   * positive definite tensor (xx, yy, zz, xy, yz, xz). Not given: 1. Not with Weights::Uniform. */
  Datum conductivity;
  /** s, at least 0; at the vertices, or in the cells if an entry names a column of the cells. */
  Datum screening;
  /** f, a density; at the vertices, or in the cells if an entry names a column of the cells. */
  Datum source;
  /** The name of the column of the cells with q: a vector for all columns, or one per column.
   * Empty: none. */
  std::string field;
  /** The initial values of the iteration, which also define the mean of unconstrained components.
   * Not given: the position if a Dirichlet value is the position, else 0. */
  Datum initial;
  /** Prescribed u at vertices; of several entries at a place the last one counts. */
  std::vector<PlacedValue> dirichlet;
  /** Prescribed (K grad u - q) . n, positive into the body, on parts of the boundary: open edges of
   * a surface, faces of one tetrahedron. Of several entries at a place the last one counts. */
  std::vector<PlacedValue> flux;
  std::vector<Robin> robin;
  /** Entries at the same place add up. */
  std::vector<Soft> soft;
  /** Whether the gradient of u and -K grad u in the cells are additional results. */
  bool gradientOutput = false, fluxOutput = false;
};

} // namespace smg
