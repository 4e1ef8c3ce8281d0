// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Blending/BlendedColumns.h"

#include "Solver/Problem/ColumnNumbers.h"

#include <algorithm>
#include <string>

namespace smg
{

namespace
{

constexpr const char* Key = "columns";

} // namespace

BlendedColumns::BlendedColumns(
  const BlendDescription& description, const StreamInfo& mesh, MeshColumns& columns)
  : Columns(columns)
{
  if (description.columns.empty())
  {
    columns.fail(Key, "must name at least one column of the vertices");
  }
  for (const std::string& name : description.columns)
  {
    this->add(name, description, mesh);
  }
  if (this->Components > BlendDescription::MostComponents)
  {
    columns.fail(Key, "have " + std::to_string(this->Components) +
                        " components together; at most " +
                        std::to_string(BlendDescription::MostComponents) +
                        " are blended at once: blend them one after the other");
  }
}

void BlendedColumns::add(
  const std::string& name, const BlendDescription& description, const StreamInfo& mesh)
{
  const NamedColumn column = this->Columns.require(name, ColumnOwner::Vertices, Key);
  if (column.owner == ColumnOwner::Cells)
  {
    this->Columns.fail(
      Key, "'" + name + "' is a column of the cells; only columns of the vertices are blended");
  }
  if (name == OriginalIdName || name == description.patch)
  {
    this->Columns.fail(Key, "'" + name + "' numbers " +
                              (name == description.patch ? "the patches" : "the vertices") +
                              " and cannot be blended");
  }
  if (std::ranges::find(this->Specs, name, &ColumnSpec::name) != this->Specs.end())
  {
    this->Columns.fail(Key, "name '" + name + "' twice");
  }
  this->Named.push_back(column);
  this->Specs.push_back(*std::ranges::find(mesh.vertexColumns, name, &ColumnSpec::name));
  this->Components += column.components;
}

void BlendedColumns::read(const MeshBlock& block, std::span<double> values) const
{
  const auto stride = static_cast<std::size_t>(this->Components);
  std::size_t first = 0;
  for (const NamedColumn& named : this->Named)
  {
    const Column& column = named.in(block);
    const auto components = static_cast<std::size_t>(named.components);
    dispatch(column.spec.type,
      [&]<class T>(T)
      {
        const std::span<const T> numbers = column.as<T>();
        for (std::size_t k = 0; k < numbers.size(); ++k)
        {
          const auto number = static_cast<double>(numbers[k]);
          if (const char* flaw = flawOf(column.spec.type, number))
          {
            this->Columns.fail(Key, "'" + named.name + "' " + flaw + " at " +
                                      this->Columns.vertexName(block, k / components));
          }
          values[k / components * stride + first + k % components] = number;
        }
      });
    first += components;
  }
}

} // namespace smg
