// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/ComponentLabels.h"

#include <algorithm>
#include <cstring>
#include <functional>

// The component of each vertex: of open ones by their cells so far, of closed ones block by block,
// in memory or on a scratch file: 4 bytes for a block of 1024 vertices of one component that has a
// constraint.

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

/** Stores complete blocks, and keeps the rest for the next call. */
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

/** Stores the next block. Most blocks have only one label, which is stored once. Masses are stored
 * only if a component of the block may float: only then are means and shifts needed. A component
 * that has a constraint keeps it. */
void ComponentLabels::store(std::size_t first, std::size_t count)
{
  const auto labels = std::span<const std::int32_t>(this->Labels).subspan(first, count);
  const auto masses = std::span<const double>(this->Masses).subspan(first, count);
  const bool one = std::ranges::adjacent_find(labels, std::ranges::not_equal_to()) == labels.end();
  const auto mayFloat = [this](std::int32_t label)
  { return label >= 0 && this->Parts.isFloating(this->Parts.root(label)); };
  this->Record.clear();
  smg::append(this->Record, one ? labels.first(1) : labels);
  if (one ? mayFloat(labels.front()) : std::ranges::any_of(labels, mayFloat))
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

/** The block that was read last is kept, since its vertices are asked for one after the other. */
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

/** Decodes a record: one or all labels, followed by no or all masses. Its size tells which: labels
 * alone take at most 4 bytes per vertex, masses 8. */
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

/** Labels are checked before they are used as indices. */
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

void OpenLabels::extend(std::int64_t vertices)
{
  const std::int64_t begin = this->Labels.end();
  if (vertices > begin)
  {
    this->Labels.extendRaw(vertices);
    std::ranges::fill(this->Labels.range(begin, vertices), -1);
  }
}

/** Joins corners that do not all have the same label. All of them get the first label that is
 * found, or a new one: later cells then find equal labels, and need no search for roots. */
void OpenLabels::joinOthers(const std::int64_t* corners, int count)
{
  std::int32_t* of[4] = {};
  std::int32_t label = -1;
  for (int k = 0; k < count; ++k)
  {
    of[k] = this->Labels.at(corners[k]);
    const std::int32_t other = *of[k];
    label = label < 0                     ? other
            : other < 0 || other == label ? label
                                          : this->Parts.join(label, other);
  }
  if (label < 0)
  {
    label = this->Parts.labels() < this->Most ? this->Parts.add() : 0;
  }
  for (int k = 0; k < count; ++k)
  {
    *of[k] = label;
  }
}

/** Passes on the current root, which shortens later searches; labels that are joined afterwards are
 * resolved when they are read. */
std::int32_t OpenComponents::close(std::int64_t i, double mass)
{
  const std::int32_t label =
    this->Labels[i] < 0 ? ComponentLabels::None : this->Parts.root(this->Labels[i]);
  this->LabelBatch.push_back(label);
  this->MassBatch.push_back(mass);
  return label;
}

std::int32_t OpenComponents::closeUndetermined(std::int64_t i)
{
  const std::int32_t label = this->close(i, 0.0);
  // Its component, if any, is returned, but its label says that the value is no solution.
  this->LabelBatch.back() = ComponentLabels::Undetermined;
  return label;
}

void OpenComponents::flush()
{
  this->Closed.append(this->LabelBatch, this->MassBatch);
  this->LabelBatch.clear();
  this->MassBatch.clear();
}

} // namespace smg
