// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"

#include "vtkStreamingMultigridIOModule.h"

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataArraySelection;
class vtkDataSetAttributes;
class vtkPointSet;
template <class T>
class vtkSmartPointer;

namespace smg
{

/** The scalar type of a VTK array; none for bits, strings and the like. */
std::optional<ScalarType> scalarTypeOf(vtkDataArray& array);

/** The first components of an array as integers. Integers of 64 bits keep all of them, which double
 * has not; numbers that are no integers are truncated. */
VTKSTREAMINGMULTIGRIDIO_EXPORT std::vector<std::int64_t> integersOf(vtkDataArray& array);

/** Creates a named VTK array with the type and the values of the column. GetRange() of it is that
 * of the finite values, where there are some. */
VTKSTREAMINGMULTIGRIDIO_EXPORT vtkSmartPointer<vtkDataArray> makeArray(const Column& column);

/** The columns of the named numeric arrays, without those of the piece contract. */
VTKSTREAMINGMULTIGRIDIO_EXPORT std::vector<ColumnSpec> columnSpecs(vtkDataSetAttributes& arrays);

/** Throws Error, naming the arrays that there are, if neither the points nor the cells have a
 * numeric array of one of these names. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void requireArrays(
  vtkPointSet& mesh, const std::set<std::string>& names);

/** The tuples `rows` of the array `column.spec.name`. Throws Error if it is absent or differs. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void copyColumn(vtkDataSetAttributes& arrays,
  std::span<const std::int64_t> rows, const std::string& where, Column& column);

/**
 * Adds the columns to a selection as selected; existing entries do not change. The marks of
 * degenerate and duplicate cells, and the arrays of the piece contract, are part of every piece and
 * cannot be selected. `before`, unless null, has the names of the columns that were offered before,
 * of which the others are removed, and gets those of these columns.
 */
void offerColumns(vtkDataArraySelection& selection, const std::vector<ColumnSpec>& columns,
  std::vector<std::string>* before = nullptr);

/** The names of the selected columns, and of those marks. */
std::vector<std::string> chosenColumns(
  vtkDataArraySelection& selection, const std::vector<ColumnSpec>& columns);

} // namespace smg
