// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/ColumnHandles.h"

#include "Filters/Streaming/ColumnPlace.h"
#include "Solver/Core/Error.h"

#include <algorithm>
#include <cmath>

namespace smg
{
namespace
{

constexpr std::array<int, 4> Components{ 1, 3, 3, 1 };

[[noreturn]] void refuse(
  const Column& column, const MeshBlock& block, std::size_t vertex, const std::string& what)
{
  throw Error("The array " + column.spec.name + " has " + what + " at the held vertex " +
              std::to_string(block.firstVertex + static_cast<std::int64_t>(vertex)) +
              " of the mesh stream: correct the Mesh Handle that made it.");
}

/** Reads the column's values as doubles. */
void copyNumbers(const Column& column, std::vector<double>& values)
{
  dispatch(column.spec.type,
    [&]<class T>(T)
    {
      const auto numbers = column.as<T>();
      std::copy(numbers.begin(), numbers.end(), values.begin());
    });
}

/** The count of handles; a mask of another scalar type than uint8 may say anything. */
void copyMask(const Column& column, const MeshBlock& block, std::vector<std::uint8_t>& mask)
{
  if (column.spec.type == ScalarType::UInt8)
  {
    const auto counts = column.as<std::uint8_t>();
    std::copy(counts.begin(), counts.end(), mask.begin());
    return;
  }
  for (std::size_t vertex = 0; vertex < mask.size(); ++vertex)
  {
    const double count = column.value(vertex);
    if (!(count >= 0.0) || !std::isfinite(count))
    {
      refuse(column, block, vertex, "a value that is no count of handles");
    }
    // A fraction holds, too: what is not 0 is held.
    mask[vertex] = static_cast<std::uint8_t>(std::min(std::ceil(count), 255.0));
  }
}

} // namespace

const std::array<std::string, 4>& ColumnHandles::names()
{
  static const std::array<std::string, 4> names{ HandleMaskName, HandleTargetName,
    HandleRotationName, HandleLogScaleName };
  return names;
}

bool ColumnHandles::isName(const std::string& name)
{
  return std::find(names().begin(), names().end(), name) != names().end();
}

ColumnHandles::ColumnHandles(const std::vector<ColumnSpec>& vertexColumns)
{
  for (std::size_t i = 0; i < this->Places.size(); ++i)
  {
    const std::string& name = names()[i];
    this->Places[i] = placeOfColumn(vertexColumns, name);
    if (this->Places[i] < 0)
    {
      throw Error("The mesh has no numeric point array " + name +
                  ", so it has no handles to deform it by: put a Mesh Handle before this filter.");
    }
    const int components = vertexColumns[this->Places[i]].components;
    if (components != Components[i])
    {
      throw Error("The point array " + name + " has " + std::to_string(components) +
                  " components instead of " + std::to_string(Components[i]) +
                  ": let a Mesh Handle make it.");
    }
  }
}

void ColumnHandles::at(const MeshBlock& block, VertexHandles& handles)
{
  const auto column = [&](int i) -> const Column& { return block.vertexColumns[this->Places[i]]; };
  copyMask(column(0), block, handles.mask);
  const std::array<std::vector<double>*, 3> values{ &handles.target, &handles.rotation,
    &handles.logScale };
  for (int i = 0; i < 3; ++i)
  {
    copyNumbers(column(i + 1), *values[i]);
    const std::size_t components = Components[i + 1];
    for (std::size_t k = 0; k < values[i]->size(); ++k)
    {
      if (handles.mask[k / components] != 0 && !std::isfinite((*values[i])[k]))
      {
        refuse(column(i + 1), block, k / components, "a value that is not a finite number");
      }
    }
  }
}

} // namespace smg
