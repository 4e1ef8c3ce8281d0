// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/SystemRecords.h"

#include "Solver/Assembly/ComponentLabels.h"

#include <algorithm>
#include <cstring>

// Most blocks have no edge to a known vertex, shares of 1 and one component: their records are
// little more than the header.

namespace smg
{
static_assert(RowBlock::Nodes == static_cast<std::int64_t>(ComponentLabels::Block));

void SystemRecords::link(std::int32_t delta, double weight)
{
  this->Links.push_back({ this->Open.nodes, delta, weight });
}

void SystemRecords::unknown(double share, std::int32_t label, double rowSum)
{
  // Of all nodes once one differs from what is usual.
  const auto keep = [this](std::vector<double>& values, double value, double usual)
  {
    if (value != usual || !values.empty())
    {
      values.resize(static_cast<std::size_t>(this->Open.nodes), usual);
      values.push_back(value);
    }
  };
  this->IsUnknown = true;
  keep(this->Shares, share, 1.0);
  if (this->Kept == KeptRowSums::Own)
  {
    keep(this->RowSums, rowSum, 0.0);
  }
  if (this->Runs.empty() || this->Runs.back().label != label)
  {
    this->Runs.push_back({ this->Open.nodes, label });
  }
}

void SystemRecords::close(const double* /*point*/, std::int64_t reach)
{
  if (!this->IsUnknown)
  {
    this->Known.push_back(static_cast<std::int16_t>(this->Open.nodes));
  }
  this->IsUnknown = false;
  // `reach` does not decrease, so the last vertex of a group determines the reach of the group.
  this->Open.reach[static_cast<std::size_t>(this->Open.nodes / RowBlock::Group)] = reach;
  ++this->Open.nodes;
  ++this->Vertices;
  if (this->Open.nodes == RowBlock::Nodes)
  {
    this->pack();
  }
}

/** The last block may have fewer vertices. */
void SystemRecords::finish()
{
  if (this->Open.nodes > 0)
  {
    this->pack();
  }
  this->Records.finish();
}

/** Completes the open block. */
void SystemRecords::pack()
{
  const auto complete = [this](std::vector<double>& values, double usual)
  {
    values.resize(values.empty() ? 0 : static_cast<std::size_t>(this->Open.nodes), usual);
    return static_cast<std::int32_t>(values.size());
  };
  this->Open.links = static_cast<std::int32_t>(this->Links.size());
  this->Open.shares = complete(this->Shares, 1.0);
  this->Open.rowSums = complete(this->RowSums, 0.0);
  this->Open.runs = static_cast<std::int32_t>(this->Runs.size());
  this->Open.known = static_cast<std::int32_t>(this->Known.size());
  Buffer buffer(this->Records.pool(), SystemRecord::bytes(this->Open));
  const SystemRecord record{ VertexRecords::Record(buffer.bytes()) };
  record.header() = this->Open;
  std::ranges::copy(this->Links, record.links().begin());
  std::ranges::copy(this->Shares, record.shares().begin());
  std::ranges::copy(this->RowSums, record.rowSums().begin());
  std::ranges::copy(this->Runs, record.runs().begin());
  std::ranges::copy(this->Known, record.known().begin());
  this->Records.append(std::move(buffer));
  this->Open = {};
  this->Open.first = this->Vertices;
  this->Links.clear();
  this->Shares.clear();
  this->RowSums.clear();
  this->Runs.clear();
  this->Known.clear();
}

void SystemRecords::save(StateWriter& state)
{
  state.part("system");
  state(this->Vertices);
  this->Records.save(state);
}

void SystemRecords::load(StateReader& state)
{
  state.part("system");
  state(this->Vertices);
  state.require(this->Vertices > 0);
  this->Records.load(state, (this->Vertices - 1) / RowBlock::Nodes + 1,
    [&](std::int64_t index, std::span<const std::byte> bytes)
    {
      SystemRecord::Header h;
      state.require(bytes.size() >= sizeof(h));
      std::memcpy(&h, bytes.data(), sizeof(h));
      const std::int64_t first = index * RowBlock::Nodes;
      const std::int64_t nodes = std::min(RowBlock::Nodes, this->Vertices - first);
      // What is read from a checkpoint is checked before it is used as sizes and indices.
      state.require(h.first == first && h.nodes == nodes && h.links >= 0 &&
                    (h.shares == 0 || h.shares == nodes) &&
                    (h.rowSums == 0 || h.rowSums == nodes) && h.runs >= 0 && h.known >= 0 &&
                    SystemRecord::bytes(h) == bytes.size());
    });
}

} // namespace smg
