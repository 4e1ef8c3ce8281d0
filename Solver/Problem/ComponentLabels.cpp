// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/ComponentLabels.h"

#include <algorithm>
#include <functional>

namespace smg
{

void ComponentLabels::useScratch(const std::filesystem::path& folder, IoStatistics& statistics)
{
  this->Scratch.emplace(folder / "labels", statistics);
  this->Scratch->startPass(true);
}

void ComponentLabels::append(std::span<const std::int32_t> labels)
{
  this->Count += static_cast<std::int64_t>(labels.size());
  this->Labels.insert(this->Labels.end(), labels.begin(), labels.end());
  if (!this->Scratch)
  {
    return;
  }
  std::size_t done = 0;
  for (; this->Labels.size() - done >= Block; done += Block)
  {
    this->store(std::span<const std::int32_t>(this->Labels).subspan(done, Block));
  }
  this->Labels.erase(
    this->Labels.begin(), this->Labels.begin() + static_cast<std::ptrdiff_t>(done));
}

void ComponentLabels::finish()
{
  if (!this->Scratch)
  {
    return;
  }
  if (!this->Labels.empty())
  {
    this->store(this->Labels);
  }
  this->Scratch->endPass();
}

void ComponentLabels::store(std::span<const std::int32_t> labels)
{
  const bool one = std::ranges::adjacent_find(labels, std::ranges::not_equal_to()) == labels.end();
  this->Scratch->append(std::as_bytes(one ? labels.first(1) : labels));
}

std::span<const std::int32_t> ComponentLabels::block(std::int64_t index)
{
  const auto first = static_cast<std::size_t>(index) * Block;
  const std::size_t count = std::min(Block, static_cast<std::size_t>(this->Count) - first);
  if (!this->Scratch)
  {
    return std::span<const std::int32_t>(this->Labels).subspan(first, count);
  }
  if (this->Cached != index)
  {
    this->Labels.resize(this->Scratch->bytes(index) / sizeof(std::int32_t));
    this->Scratch->read(index, std::as_writable_bytes(std::span<std::int32_t>(this->Labels)));
    this->Labels.resize(count, this->Labels.front());
    this->Cached = index;
  }
  return this->Labels;
}

} // namespace smg
