// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <string_view>
#include <utility>
#include <vector>

namespace smg
{

/** Whether a column is an argument of jobs alone, by its name: results and files do not have it. */
constexpr bool isArgument(std::string_view name)
{
  return name.starts_with('#');
}

/** The specs without those of arguments. */
inline std::vector<ColumnSpec> withoutArguments(std::vector<ColumnSpec> specs)
{
  std::erase_if(specs, [](const ColumnSpec& spec) { return isArgument(spec.name); });
  return specs;
}

/** The same of vertices and cells. */
inline StreamInfo withoutArguments(StreamInfo info)
{
  info.vertexColumns = withoutArguments(std::move(info.vertexColumns));
  info.cellColumns = withoutArguments(std::move(info.cellColumns));
  return info;
}

/** A stream without the columns that are arguments. The source must outlive it. */
class WithoutArguments : public MeshSource
{
public:
  explicit WithoutArguments(MeshSource& source)
    : Source(source)
    , Info(withoutArguments(source.info()))
  {
  }

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override
  {
    if (!this->Source.next(block))
    {
      return false;
    }
    for (std::vector<Column>* columns : { &block.vertexColumns, &block.cellColumns })
    {
      std::erase_if(*columns, [](const Column& column) { return isArgument(column.spec.name); });
    }
    return true;
  }

private:
  MeshSource& Source;
  StreamInfo Info;
};

} // namespace smg
