// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/OpenVertices.h"
#include "Solver/Problem/Coefficient.h"
#include "smg/ProblemDescription.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

// The data of a problem, in one table. Whatever must know all of them follows it: composing,
// comparing and naming descriptions (ComposeDescriptions.cpp), resolving them on a mesh
// (DescribedProblem.cpp), reading them (IO/Description/ProblemFile.cpp), and the conditions of the
// VTK filters (Filters/Regions/ConditionText.cpp).

namespace smg
{

// What the values of a datum may be, for a problem with this many columns.

inline ValueRules solutionRules(int columns)
{
  return { .components = { columns }, .positions = columns == 3 };
}

/** A solution, whose values may be missing, is an initial value of another solve. */
inline ValueRules initialRules(int columns)
{
  ValueRules rules = solutionRules(columns);
  rules.missing = true;
  return rules;
}

inline ValueRules coefficientRules(int /*columns*/)
{
  return { .components = { 1 }, .range = ValueRange::NotNegative };
}

inline ValueRules conductivityRules(int /*columns*/)
{
  return { .components = { 1, 3, 6 },
    .range = ValueRange::PositiveDefinite,
    .preferred = ColumnOwner::Cells };
}

/** 3 components: one vector for all columns. */
inline ValueRules fieldRules(int columns)
{
  return { .components = columns == 1 ? std::vector{ 3 } : std::vector{ 3, 3 * columns },
    .preferred = ColumnOwner::Cells };
}

// The rows of the table.

/** A value in each part of the mesh. */
struct DatumRow
{
  const char* key; ///< in problem files and messages
  Datum ProblemDescription::*member;
  DataPlace place;
  ValueRules (*rules)(int columns);
  bool poses; ///< whether it poses a problem by itself: without it the solution may be other than 0
  /** What it sets at vertices, or in cells if an entry names a column of the cells; null: more than
   * a density. */
  const Density* density = nullptr;
};

/** A column of the mesh, everywhere. */
struct ColumnRow
{
  const char* key;
  std::string ProblemDescription::*member;
  DataPlace place;
  ValueRules (*rules)(int columns);
  bool poses;
};

/** A list of conditions, each with a part of the mesh, a value of u or of its flux, and perhaps a
 * coefficient. */
template <class Condition>
struct ConditionRow
{
  const char* key;
  std::vector<Condition> ProblemDescription::*member;
  DataPlace place;
  const char* valueKey;
  DataValue Condition::*value;
  const char* coefficientKey = nullptr;
  Datum Condition::*coefficient = nullptr;
  ValueRules (*rules)(int columns) = solutionRules; ///< of the values
  bool poses = true;
};

/** All data, in the order in which they are read and checked. */
inline constexpr std::tuple ProblemData{
  DatumRow{
    "conductivity", &ProblemDescription::conductivity, DataPlace::Cells, conductivityRules, false },
  DatumRow{ "screening", &ProblemDescription::screening, DataPlace::Vertices, coefficientRules,
    false, &Densities[ScreeningDensity] },
  DatumRow{ "source", &ProblemDescription::source, DataPlace::Vertices, solutionRules, true,
    &Densities[SourceDensity] },
  ColumnRow{ "field", &ProblemDescription::field, DataPlace::Cells, fieldRules, true },
  // Without conditions, it determines the mean of the solution.
  DatumRow{ "initial", &ProblemDescription::initial, DataPlace::Vertices, initialRules, true },
  ConditionRow<PlacedValue>{ "dirichlet", &ProblemDescription::dirichlet, DataPlace::Vertices,
    "value", &PlacedValue::value },
  ConditionRow<PlacedValue>{
    "flux", &ProblemDescription::flux, DataPlace::Facets, "value", &PlacedValue::value },
  ConditionRow<ProblemDescription::Robin>{ "robin", &ProblemDescription::robin, DataPlace::Facets,
    "ambient", &ProblemDescription::Robin::ambient, "coefficient",
    &ProblemDescription::Robin::coefficient },
  ConditionRow<ProblemDescription::Soft>{ "soft", &ProblemDescription::soft, DataPlace::Vertices,
    "value", &ProblemDescription::Soft::value, "weight", &ProblemDescription::Soft::weight },
};

/** Calls `visit` with each row. */
constexpr void forProblemData(auto visit)
{
  std::apply([&](const auto&... row) { (visit(row), ...); }, ProblemData);
}

/** The number of the row with this key. */
consteval std::size_t rowOf(std::string_view key)
{
  std::size_t row = 0, found = std::tuple_size_v<decltype(ProblemData)>;
  forProblemData([&](const auto& datum) { found = key == datum.key ? row : found, ++row; });
  // No constant expression if there is no such datum.
  return row == found ? throw key : found;
}

/** The keys of a problem file. */
inline constexpr auto ProblemKeys = std::apply(
  [](const auto&... row)
  {
    return std::array{ "weights", "columns", row.key..., "periodic", "interface", "outputs",
      "integrals" };
  },
  ProblemData);

} // namespace smg
