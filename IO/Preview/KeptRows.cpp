// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/KeptRows.h"

#include <algorithm>

namespace smg
{

KeptRows::KeptRows(const std::vector<ColumnSpec>& vertexColumns)
  : Specs(vertexColumns)
{
}

void KeptRows::take(const MeshBlock& block)
{
  if (!this->Specs.empty() && block.vertices() > 0)
  {
    this->Window.push_back(
      { block.firstVertex, block.firstVertex + block.vertices(), block.vertexColumns });
  }
}

void KeptRows::forgetBelow(std::int64_t finalized)
{
  while (!this->Window.empty() && this->Window.front().end <= finalized)
  {
    this->Window.pop_front();
  }
}

void KeptRows::keep(std::int64_t id)
{
  if (this->Specs.empty())
  {
    return;
  }
  const auto [entry, isNew] = this->Kept.try_emplace(id);
  if (!isNew)
  {
    return;
  }
  const auto block = std::upper_bound(this->Window.begin(), this->Window.end(), id,
    [](std::int64_t vertex, const Block& after) { return vertex < after.end; });
  for (const Column& column : block->columns)
  {
    const auto size = static_cast<std::ptrdiff_t>(column.spec.tupleBytes());
    const auto from = column.bytes.begin() + (id - block->first) * size;
    entry->second.insert(entry->second.end(), from, from + size);
  }
}

void KeptRows::thin(const std::function<bool(std::int64_t)>& isWanted)
{
  std::erase_if(this->Kept, [&isWanted](const auto& entry) { return !isWanted(entry.first); });
}

std::vector<Column> KeptRows::gather(const std::vector<std::int64_t>& ids) const
{
  std::vector<Column> columns;
  std::ptrdiff_t offset = 0;
  for (const ColumnSpec& spec : this->Specs)
  {
    columns.push_back({ spec, {} });
    const auto size = static_cast<std::ptrdiff_t>(spec.tupleBytes());
    for (const std::int64_t id : ids)
    {
      const auto from = this->Kept.at(id).begin() + offset;
      columns.back().bytes.insert(columns.back().bytes.end(), from, from + size);
    }
    offset += size;
  }
  return columns;
}

} // namespace smg
