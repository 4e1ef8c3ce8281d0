// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/ComponentLabels.h"

#include <algorithm>
#include <cstring>
#include <functional>

namespace smg
{
namespace
{

template <class T>
void append(std::vector<std::byte>& record, std::span<const T> values)
{
  const auto bytes = std::as_bytes(values);
  record.insert(record.end(), bytes.begin(), bytes.end());
}

} // namespace

void ComponentLabels::useScratch(const ScratchFolder& folder, IoStatistics& statistics)
{
  this->Scratch.emplace(folder, "labels", statistics);
  this->Scratch->startPass(true);
}

void ComponentLabels::append(std::span<const std::int32_t> labels, std::span<const double> masses)
{
  this->Count += static_cast<std::int64_t>(labels.size());
  this->Labels.insert(this->Labels.end(), labels.begin(), labels.end());
  this->Masses.insert(this->Masses.end(), masses.begin(), masses.end());
  std::size_t done = 0;
  for (; this->Labels.size() - done >= Block; done += Block)
  {
    this->store(done, Block);
  }
  const auto stored = static_cast<std::ptrdiff_t>(done);
  this->Labels.erase(this->Labels.begin(), this->Labels.begin() + stored);
  this->Masses.erase(this->Masses.begin(), this->Masses.begin() + stored);
}

void ComponentLabels::finish()
{
  if (!this->Labels.empty())
  {
    this->store(0, this->Labels.size());
  }
  if (this->Scratch)
  {
    this->Scratch->endPass();
  }
}

/** Most blocks have one label only, which is stored once, and no masses. */
void ComponentLabels::store(std::size_t first, std::size_t count)
{
  const auto labels = std::span<const std::int32_t>(this->Labels).subspan(first, count);
  const auto masses = std::span<const double>(this->Masses).subspan(first, count);
  const bool one = std::ranges::adjacent_find(labels, std::ranges::not_equal_to()) == labels.end();
  const auto mayBeFree = [this](std::int32_t label)
  { return label >= 0 && this->Parts.isFree(this->Parts.root(label)); };
  this->Record.clear();
  smg::append(this->Record, one ? labels.first(1) : labels);
  if (one ? mayBeFree(labels.front()) : std::ranges::any_of(labels, mayBeFree))
  {
    smg::append(this->Record, masses);
  }
  if (this->Scratch)
  {
    this->Scratch->append(this->Record);
    return;
  }
  this->Stored.push_back(this->Record);
}

ComponentLabels::Entries ComponentLabels::block(std::int64_t index)
{
  if (this->Cached != index)
  {
    if (this->Scratch)
    {
      this->Record.resize(this->Scratch->bytes(index));
      this->Scratch->read(index, this->Record);
    }
    const std::vector<std::byte>& record =
      this->Scratch ? this->Record : this->Stored[static_cast<std::size_t>(index)];
    this->decode(record, this->blockCount(index));
    this->Cached = index;
  }
  return { this->Labels, this->Masses };
}

std::size_t ComponentLabels::blockCount(std::int64_t index) const
{
  const auto first = static_cast<std::size_t>(index) * Block;
  return std::min(Block, static_cast<std::size_t>(this->Count) - first);
}

/** A record has one or all labels, followed by no or all masses. */
void ComponentLabels::decode(std::span<const std::byte> record, std::size_t count)
{
  const bool masses = record.size() >= count * sizeof(double);
  const std::size_t bytes = record.size() - (masses ? count * sizeof(double) : 0);
  this->Labels.resize(bytes / sizeof(std::int32_t));
  std::memcpy(this->Labels.data(), record.data(), bytes);
  this->Labels.resize(count, this->Labels.front());
  this->Masses.resize(masses ? count : 0);
  std::ranges::copy(record.subspan(bytes), std::as_writable_bytes(std::span(this->Masses)).begin());
}

void ComponentLabels::save(StateWriter& state)
{
  state.part("labels");
  state(this->Count);
  this->Scratch->save(state);
}

void ComponentLabels::load(StateReader& state)
{
  state.part("labels");
  state(this->Count);
  state.require(this->Count > 0);
  const auto check = [&](std::int64_t index, std::span<const std::byte> record)
  {
    const std::size_t count = this->blockCount(index);
    const std::size_t one = sizeof(std::int32_t), masses = count * sizeof(double);
    state.require(record.size() == one || record.size() == count * one ||
                  record.size() == one + masses || record.size() == count * one + masses);
    this->decode(record, count);
    state.require(std::ranges::all_of(this->Labels, [this](std::int32_t label)
      { return label >= Undetermined && label < this->Parts.labels(); }));
  };
  constexpr auto Vertices = static_cast<std::int64_t>(Block);
  this->Scratch->load(state, (this->Count - 1) / Vertices + 1, check);
}

} // namespace smg
