// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/PieceColumns.h"

#include "IO/Mesh/Columns.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "smg/Error.h"
#include "smg/MeshSource.h"

#include "vtkArrayDispatch.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataArraySelection.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationInformationVectorKey.h"
#include "vtkInformationVariantKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <type_traits>

namespace smg
{
namespace
{

int vtkTypeOf(ScalarType type)
{
  constexpr int types[] = { VTK_TYPE_INT8, VTK_TYPE_UINT8, VTK_TYPE_INT16, VTK_TYPE_UINT16,
    VTK_TYPE_INT32, VTK_TYPE_UINT32, VTK_TYPE_INT64, VTK_TYPE_UINT64, VTK_FLOAT, VTK_DOUBLE };
  return types[static_cast<int>(type)];
}

/**
 * Copies tuples of an array without contiguous tuples, without creating a contiguous copy of it.
 */
void copyRows(vtkDataArray& array, std::span<const std::int64_t> rows, Column& column)
{
  constexpr std::size_t AtOnce = 4096;
  const auto plain = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(array.GetDataType()));
  plain->SetNumberOfComponents(array.GetNumberOfComponents());
  vtkNew<vtkIdList> ids;
  for (std::size_t first = 0; first < rows.size(); first += AtOnce)
  {
    const std::size_t count = std::min(AtOnce, rows.size() - first);
    ids->SetNumberOfIds(static_cast<vtkIdType>(count));
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(first), count, ids->begin());
    plain->SetNumberOfTuples(static_cast<vtkIdType>(count));
    array.GetTuples(ids, plain);
    const std::size_t size = column.spec.tupleBytes();
    std::memcpy(column.bytes.data() + first * size, plain->GetVoidPointer(0), count * size);
  }
}

/** A number as an integer; the smallest one for a floating-point number beyond all of them. */
template <class Number>
std::int64_t integerOf(Number number)
{
  if constexpr (std::is_floating_point_v<Number>)
  {
    constexpr auto Beyond = static_cast<Number>(0x1p63);
    return number >= -Beyond && number < Beyond ? static_cast<std::int64_t>(number)
                                                : std::numeric_limits<std::int64_t>::min();
  }
  else
  {
    return static_cast<std::int64_t>(number);
  }
}

/** The value of ColumnSpec::isolated. */
std::optional<double> isolatedValue(vtkDataArray& array)
{
  vtkInformationVariantKey* key = vtkStreamingMeshKeys::ISOLATED_VALUE();
  if (array.HasInformation() && array.GetInformation()->Has(key))
  {
    return array.GetInformation()->Get(key).ToDouble();
  }
  return std::nullopt;
}

} // namespace

std::optional<ScalarType> scalarTypeOf(vtkDataArray& array)
{
  switch (array.GetDataType())
  {
    vtkTemplateMacro(return scalarTypeOf<VTK_TT>());
    default:
      return std::nullopt;
  }
}

std::vector<std::int64_t> integersOf(vtkDataArray& array)
{
  std::vector<std::int64_t> integers;
  integers.reserve(static_cast<std::size_t>(array.GetNumberOfTuples()));
  const auto append = [&integers](auto* typed)
  {
    for (const auto tuple : vtk::DataArrayTupleRange(typed))
    {
      integers.push_back(
        integerOf(static_cast<vtk::GetAPIType<std::remove_pointer_t<decltype(typed)>>>(tuple[0])));
    }
  };
  if (!vtkArrayDispatch::Dispatch::Execute(&array, append))
  {
    // Arrays of implicit values or of bits.
    for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i)
    {
      integers.push_back(array.GetVariantValue(i * array.GetNumberOfComponents()).ToTypeInt64());
    }
  }
  return integers;
}

namespace
{

/** Gives an array with infinite values, as of points that no distance reaches, the range of the
 * finite ones: it is the default of contours and thresholds, and infinite bounds are none. */
void tellFiniteRange(vtkDataArray& array)
{
  for (int c = 0; c < array.GetNumberOfComponents(); ++c)
  {
    double range[2], finite[2];
    array.GetRange(range, c);
    array.GetFiniteRange(finite, c);
    if ((std::isinf(range[0]) || std::isinf(range[1])) && finite[0] <= finite[1])
    {
      array.GetInformation()
        ->Get(vtkDataArray::PER_COMPONENT())
        ->GetInformationObject(c)
        ->Set(vtkDataArray::COMPONENT_RANGE(), finite, 2);
    }
  }
}

bool hasInfinity(const Column& column)
{
  return dispatch(column.spec.type,
    [&column]<class T>(T)
    {
      return std::ranges::any_of(
        column.as<T>(), [](T value) { return std::isinf(static_cast<double>(value)); });
    });
}

} // namespace

vtkSmartPointer<vtkDataArray> makeArray(const Column& column)
{
  auto array =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeOf(column.spec.type)));
  array->SetName(column.spec.name.c_str());
  array->SetNumberOfComponents(column.spec.components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(column.tuples()));
  if (!column.bytes.empty())
  {
    std::memcpy(array->GetVoidPointer(0), column.bytes.data(), column.bytes.size());
  }
  if (hasInfinity(column))
  {
    tellFiniteRange(*array);
  }
  if (column.spec.isolated)
  {
    array->GetInformation()->Set(vtkStreamingMeshKeys::ISOLATED_VALUE(), *column.spec.isolated);
  }
  return array;
}

std::vector<ColumnSpec> columnSpecs(vtkDataSetAttributes& arrays)
{
  std::vector<ColumnSpec> specs;
  for (int i = 0; i < arrays.GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays.GetArray(i);
    const char* name = array ? array->GetName() : nullptr;
    if (!name || !*name || isContractArray(name) || array == arrays.GetGlobalIds())
    {
      continue;
    }
    if (const auto type = scalarTypeOf(*array))
    {
      specs.push_back({ name, *type, array->GetNumberOfComponents(), isolatedValue(*array) });
    }
  }
  return specs;
}

void requireArrays(vtkPointSet& mesh, const std::set<std::string>& names)
{
  std::set<std::string> there;
  std::string offered;
  for (vtkDataSetAttributes* arrays : { static_cast<vtkDataSetAttributes*>(mesh.GetPointData()),
         static_cast<vtkDataSetAttributes*>(mesh.GetCellData()) })
  {
    for (const ColumnSpec& spec : columnSpecs(*arrays))
    {
      there.insert(spec.name);
      offered += (offered.empty() ? " (it has " : ", ") + spec.name;
    }
  }
  for (const std::string& name : names)
  {
    // A mesh has only those of the groups that it has.
    if (!there.contains(name) && !isGroupColumn(name))
    {
      throw Error("The input has no numeric array " + name + " of its points or cells" +
                  (offered.empty() ? " (it has none)" : offered + ")") +
                  ": choose one that it has.");
    }
  }
}

void copyColumn(vtkDataSetAttributes& arrays, std::span<const std::int64_t> rows,
  const std::string& where, Column& column)
{
  vtkDataArray* array = arrays.GetArray(column.spec.name.c_str());
  if (!array || scalarTypeOf(*array) != column.spec.type ||
      array->GetNumberOfComponents() != column.spec.components)
  {
    throw Error(where + (array ? " has another kind of array " : " has no array ") +
                column.spec.name +
                ", unlike the first piece: every piece must have the same arrays.");
  }
  column.resize(rows.size());
  if (!array->HasStandardMemoryLayout())
  {
    copyRows(*array, rows, column);
    return;
  }
  const std::size_t size = column.spec.tupleBytes();
  const auto* from = static_cast<const std::byte*>(array->GetVoidPointer(0));
  std::byte* to = column.bytes.data();
  for (const std::int64_t row : rows)
  {
    std::memcpy(to, from + row * size, size);
    to += size;
  }
}

namespace
{

bool isSelectable(const ColumnSpec& column)
{
  return column.name != CellFlagsName && !isContractArray(column.name);
}

} // namespace

void offerColumns(vtkDataArraySelection& selection, const std::vector<ColumnSpec>& columns,
  std::vector<std::string>* before)
{
  if (before)
  {
    std::vector<std::string> names;
    std::ranges::transform(columns, std::back_inserter(names), &ColumnSpec::name);
    for (const std::string& name : *before)
    {
      if (std::ranges::find(names, name) == names.end())
      {
        selection.RemoveArrayByName(name.c_str());
      }
    }
    *before = std::move(names);
  }
  for (const ColumnSpec& column : columns)
  {
    if (isSelectable(column) && !selection.ArrayExists(column.name.c_str()))
    {
      selection.AddArray(column.name.c_str());
    }
  }
}

std::vector<std::string> chosenColumns(
  vtkDataArraySelection& selection, const std::vector<ColumnSpec>& columns)
{
  std::vector<std::string> names;
  for (const ColumnSpec& column : columns)
  {
    if (column.name == CellFlagsName ||
        (isSelectable(column) && selection.ArrayIsEnabled(column.name.c_str())))
    {
      names.push_back(column.name);
    }
  }
  return names;
}

} // namespace smg
