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

/** Stands for the coordinates x, y, z of a vertex, as a value of three columns. */
struct Position
{
};

/** A value of a problem: numbers, a column of the mesh, or the position. */
class DataValue
{
public:
  /** One number. */
  DataValue(double number)
    : What(std::vector{ number })
  {
  }
  /** One number for each column of the problem. */
  DataValue(std::initializer_list<double> numbers)
    : What(std::vector(numbers))
  {
  }
  /** One number for each column of the problem. */
  DataValue(std::vector<double> numbers)
    : What(std::move(numbers))
  {
  }
  /** The values of the column of the mesh with this name. */
  DataValue(std::string column)
    : What(std::move(column))
  {
  }
  /** The values of the column of the mesh with this name. */
  DataValue(const char* column)
    : What(std::string(column))
  {
  }
  /** Whose column is meant if vertices and cells both have one of the name. */
  enum class Owner
  {
    Usual, ///< cells for conductivities, vertices for all others
    Vertices,
    Cells
  };
  /** The values of the column of the mesh with this name. */
  DataValue(std::string column, Owner owner)
    : What(std::move(column))
    , Of(owner)
  {
  }
  /** The position of each vertex. */
  DataValue(Position position)
    : What(position)
  {
  }

  /** The numbers; null if this is a column or the position. */
  const std::vector<double>* numbers() const
  {
    return std::get_if<std::vector<double>>(&this->What);
  }
  /** The name of the column; null if this is numbers or the position. */
  const std::string* column() const { return std::get_if<std::string>(&this->What); }
  /** Whose column it is, if both have it. */
  Owner owner() const { return this->Of; }
  /** Whether this is the position. */
  bool isPosition() const { return std::holds_alternative<Position>(this->What); }

  using Content = std::variant<std::vector<double>, std::string, Position>; ///< all kinds
  /** The numbers, the name of the column, or the position. */
  const Content& content() const { return this->What; }

private:
  Content What;
  Owner Of = Owner::Usual;
};

/** A value in a part of the mesh. */
struct PlacedValue
{
  Where where;     ///< the part
  DataValue value; ///< the value there
};

/** A datum of a problem, part by part of the mesh. */
struct Datum
{
  /** Where several entries hold, the last one counts. Empty: the datum is not given. */
  std::vector<PlacedValue> entries;

  /** Not given. */
  Datum() = default;
  /** The same value everywhere. */
  template <std::convertible_to<DataValue> Value>
  Datum(Value&& value)
    : entries{ { Everywhere{}, std::forward<Value>(value) } }
  {
  }
  /** These entries. */
  Datum(std::initializer_list<PlacedValue> placed)
    : entries(placed)
  {
  }

  /** Whether there is an entry. */
  bool isGiven() const { return !this->entries.empty(); }
};

/**
 * An elliptic problem -div(K grad u - q) + s u = f in terms of regions and columns of a mesh.
 * DescribedProblem makes a Problem of it. By default it is the Laplace equation with one column.
 *
 *     ProblemDescription heat;
 *     heat.conductivity = { { Everywhere{}, 1.0 }, { ColumnTag{ "PhysicalTag", 3 }, 10.0 } };
 *     heat.source = "heating";
 *     heat.dirichlet = { { Region::Sphere{ { 0, 0, 0 }, 0.1 }, 20.0 } };
 *     heat.robin = { { ColumnMask{ "outside" }, 5.0, 4.0 } };
 *
 * Values (u, f, fluxes) have `columns` numbers, coefficients one; all must be finite, with a
 * magnitude of at most 1e150. A column of the vertices that is used in a cell counts by the mean of
 * the corners. Units are the user's own: the solver does not convert any.
 */
struct ProblemDescription
{
  /** Largest number of columns. */
  static constexpr int MaxColumns = 64;

  /** An exchange through a part of the boundary: (K grad u - q) . n = coefficient * (ambient - u).
   */
  struct Robin
  {
    Where where;       ///< the part of the boundary
    Datum coefficient; ///< at least 0
    DataValue ambient; ///< value of the surroundings
  };
  /** A soft constraint: adds the density weight * (u - value) to the equations of vertices. */
  struct Soft
  {
    Where where;     ///< the vertices
    Datum weight;    ///< at least 0
    DataValue value; ///< the value that u is pulled towards
  };

  /** Two sides of the mesh that are one: each facet of `to` is a facet of `from`, moved by the same
   * vector, and u is there what it is here, and `jump`. */
  struct Periodic
  {
    Where from;                    ///< a group of facets, a region or a column
    Where to;                      ///< likewise
    std::vector<double> jump = {}; ///< one number, or one for each column; empty: 0
    /** How far corners may be from where they should be; 0: 1e-6 of the diagonal of a side. */
    double tolerance = 0.0;
  };
  /** A contact between bodies that have a copy each of its facets: through each of them there flows
   * coefficient * (u on this side - u on the other side), per area or length. */
  struct Interface
  {
    Where where;              ///< the facets of both bodies: groups, a region or a column
    double coefficient = 0.0; ///< at least 0
    double tolerance = 0.0;   ///< as of Periodic
  };

  /** The weights of the edges. */
  Weights weights = Weights::Cotangent;
  /** Right-hand sides that are solved at once, 1 to MaxColumns. */
  int columns = 1;
  /** K in the cells: a positive number, the diagonal of a tensor (xx, yy, zz), or a symmetric
   * positive definite tensor (xx, yy, zz, xy, yz, xz). Not given: 1. Not with Weights::Uniform. */
  Datum conductivity;
  /** s, at least 0. Holds at the vertices, but in the cells if an entry names a cell column. Not
   * given: 0. */
  Datum screening;
  /** f, a density. Holds at the vertices, but in the cells if an entry names a cell column. Not
   * given: 0. */
  Datum source;
  /** Name of the cell column with q: 3 components for all columns, or 3 for each. Empty: q = 0. */
  std::string field;
  /** Where the iteration begins; the mean of u in components without a condition. Not given: the
   * position if a value is that; the middle of numbers that differ, but are nearer to each other
   * than to 0; else 0. */
  Datum initial;
  /** Prescribed u at vertices. Where several entries hold, the last one counts. */
  std::vector<PlacedValue> dirichlet;
  /** Prescribed (K grad u - q) . n, positive into the body, on the boundary: open edges of a
   * surface, faces of a single tetrahedron. Where several entries hold, the last one counts. */
  std::vector<PlacedValue> flux;
  /** Robin conditions. Where several entries hold, the last one counts. */
  std::vector<Robin> robin;
  /** Soft constraints. Where several entries hold, they add up. */
  std::vector<Soft> soft;
  /** Sides that are one. With Weights::Cotangent. */
  std::vector<Periodic> periodic;
  /** Contacts of bodies. Where several entries hold, they add up. With Weights::Cotangent. */
  std::vector<Interface> interfaces;
  bool gradientOutput = false; ///< whether grad u of the cells is wanted as a result
  /** Whether grad u at the vertices is, the mean of the cells weighted by area or volume. */
  bool vertexGradientOutput = false;
  bool fluxOutput = false; ///< whether -K grad u of the cells is wanted as a result
  /** Groups of cells, by names, numbers or patterns with `*`, over which the solution is integrated
   * for the report: Report::integrals. "*" alone stands for the whole and every group of cells. */
  std::vector<std::string> integrals;
};

} // namespace smg
