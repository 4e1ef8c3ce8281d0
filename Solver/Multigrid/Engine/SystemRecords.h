// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/KnownLinks.h"
#include "Solver/Assembly/RowAssembly.h"
#include "Solver/Multigrid/Cycle/RowBlock.h"
#include "Solver/Multigrid/Engine/VertexRecords.h"
#include "smg/Export.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/**
 * What a further system needs of the vertices of a block of rows that the rows do not have: which
 * rows are those of the identity, the edges to such vertices, which rows omit, how the residual of
 * each row counts, the component of each unknown, and how far neighbours reach. Nodes are counted
 * from the first one of the block.
 */
class SystemRecord
{
public:
  struct Header
  {
    std::int64_t first = 0;
    std::int32_t nodes = 0;
    std::int32_t links = 0, shares = 0, rowSums = 0, runs = 0, known = 0; ///< sizes of the arrays
    /** The largest neighbour in the mesh, known or not, of nodes 0 .. end of the group. */
    std::array<std::int64_t, RowBlock::Groups> reach{};
  };
  /** From this node on, unknowns are of this component. */
  struct Run
  {
    std::int32_t begin, label;
  };

  explicit SystemRecord(VertexRecords::Record record)
    : Bytes(std::move(record))
  {
  }

  static std::size_t bytes(const Header& h)
  {
    return sizeof(Header) + sized<KnownLink>(h.links) + sized<double>(h.shares) +
           sized<double>(h.rowSums) + sized<Run>(h.runs) + sized<std::int16_t>(h.known);
  }

  Header& header() const { return *reinterpret_cast<Header*>(this->Bytes.data()); }
  std::int64_t first() const { return this->header().first; }
  std::int64_t end() const { return this->header().first + this->header().nodes; }
  /** By ascending node and neighbour. */
  std::span<KnownLink> links() const
  {
    return array<KnownLink>(this->header().links, sizeof(Header));
  }
  /** Of all nodes; empty: 1. */
  std::span<double> shares() const
  {
    const Header& h = this->header();
    return array<double>(h.shares, sizeof(Header) + sized<KnownLink>(h.links));
  }
  /** Of all nodes; empty: 0. */
  std::span<double> rowSums() const
  {
    const Header& h = this->header();
    return array<double>(
      h.rowSums, sizeof(Header) + sized<KnownLink>(h.links) + sized<double>(h.shares));
  }
  std::span<Run> runs() const
  {
    const Header& h = this->header();
    return array<Run>(h.runs, sizeof(Header) + sized<KnownLink>(h.links) + sized<double>(h.shares) +
                                sized<double>(h.rowSums));
  }
  /** The nodes with rows of the identity, ascending. */
  std::span<std::int16_t> known() const
  {
    const Header& h = this->header();
    return array<std::int16_t>(h.known, bytes(h) - sized<std::int16_t>(h.known));
  }

private:
  template <class T>
  static std::size_t sized(std::int32_t count)
  {
    return static_cast<std::size_t>(count) * sizeof(T);
  }
  template <class T>
  std::span<T> array(std::int32_t count, std::size_t at) const
  {
    return { reinterpret_cast<T*>(this->Bytes.data() + at), static_cast<std::size_t>(count) };
  }

  VertexRecords::Record Bytes;
};

/** The part of the diagonals that SystemRecords keep. */
enum class KeptRowSums
{
  None,
  Own ///< screening, Robin conditions and the like, without the edges to known vertices
};

/** The records of all blocks, collected in the first pass. */
class SMG_EXPORT SystemRecords final : public RowListener
{
public:
  SystemRecords(Pool& pool, KeptRowSums rowSums)
    : Records(pool, "system")
    , Kept(rowSums)
  {
  }

  void useScratch(const ScratchFolder& folder, ScratchTraffic& traffic)
  {
    this->Records.useScratch(folder, traffic);
  }

  // During the first pass:

  void link(std::int32_t delta, double weight) override;
  void unknown(double share, std::int32_t label, double rowSum) override;
  void close(const double* point, std::int64_t reach) override;
  void finish();

  // Afterwards:

  void startPass() { this->Records.startPass(); }
  SystemRecord next() { return SystemRecord(this->Records.next()); }
  void endPass() { this->Records.endPass(); }
  void save(StateWriter& state);
  void load(StateReader& state);

private:
  void pack();

  VertexRecords Records;
  KeptRowSums Kept;
  // Of the open block.
  SystemRecord::Header Open;
  std::vector<KnownLink> Links;
  std::vector<double> Shares, RowSums;
  std::vector<SystemRecord::Run> Runs;
  std::vector<std::int16_t> Known;
  std::int64_t Vertices = 0;
  bool IsUnknown = false; // the next vertex
};

/** The records of the vertices that a pass has loaded and that a system still needs. */
class OpenRecords
{
public:
  explicit OpenRecords(SystemRecords& records)
    : All(records)
  {
  }

  void startPass() { this->All.startPass(); }
  void endPass() { this->All.endPass(); }
  /** Loads the records of the vertices below `end`, a multiple of a block or the number of all. */
  void load(std::int64_t end)
  {
    while (this->End < end)
    {
      this->Records.push_back(this->All.next());
      this->End = this->Records.back().end();
    }
  }
  /** Releases the records of blocks whose vertices are all below `end`. */
  void release(std::int64_t end)
  {
    while (!this->Records.empty() && this->Records.front().end() <= end)
    {
      this->Records.pop_front();
    }
  }
  /** The first vertex that is not released. */
  std::int64_t first() const
  {
    return this->Records.empty() ? this->End : this->Records.front().first();
  }

  const SystemRecord& of(std::int64_t vertex) const
  {
    // Blocks have a fixed number of vertices.
    return this->Records[static_cast<std::size_t>((vertex - this->first()) / RowBlock::Nodes)];
  }
  /** The end of the vertices from `cursor` on whose neighbours in the mesh, known or not, are all
   * below `done`: in groups, as stages advance. */
  std::int64_t reachable(std::int64_t cursor, std::int64_t done) const
  {
    while (cursor < done)
    {
      const SystemRecord::Header& h = this->of(cursor).header();
      const std::int64_t group = (cursor - h.first) / RowBlock::Group;
      if (h.reach[static_cast<std::size_t>(group)] >= done)
      {
        break;
      }
      cursor = h.first + std::min<std::int64_t>(h.nodes, (group + 1) * RowBlock::Group);
    }
    return cursor;
  }

private:
  SystemRecords& All;
  std::deque<SystemRecord> Records;
  std::int64_t End = 0;
};

} // namespace smg
