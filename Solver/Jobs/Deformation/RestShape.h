// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/RowAssembly.h"
#include "Solver/Multigrid/Engine/SystemRecords.h"
#include "Solver/Multigrid/Engine/VertexRecords.h"

#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/** The positions at rest of the vertices of a block of rows, and the targets of held vertices. */
class RestBlock
{
public:
  struct Header
  {
    std::int64_t first = 0;
    std::int32_t nodes = 0;
    std::int32_t held = 0;
  };
  struct Held
  {
    std::array<double, 3> target;
    std::int64_t node; ///< counted from the first node of the block
  };

  explicit RestBlock(VertexRecords::Record record)
    : Bytes(std::move(record))
  {
  }

  static std::size_t bytes(const Header& h)
  {
    return sizeof(Header) + static_cast<std::size_t>(h.nodes) * 3 * sizeof(double) +
           static_cast<std::size_t>(h.held) * sizeof(Held);
  }

  Header& header() const { return *reinterpret_cast<Header*>(this->Bytes.data()); }
  std::int64_t first() const { return this->header().first; }
  std::int64_t end() const { return this->header().first + this->header().nodes; }
  /** x, y, z of each node. */
  std::span<double> points() const
  {
    return { reinterpret_cast<double*>(this->Bytes.data() + sizeof(Header)),
      static_cast<std::size_t>(this->header().nodes) * 3 };
  }
  /** By ascending node. */
  std::span<Held> held() const
  {
    return { reinterpret_cast<Held*>(this->points().data() + this->points().size()),
      static_cast<std::size_t>(this->header().held) };
  }

private:
  VertexRecords::Record Bytes;
};

/** The mesh at rest and its targets, and what further systems need of it, written in the first pass
 * to scratch files or memory. */
class RestShape : public RowListener
{
public:
  explicit RestShape(Pool& pool)
    : Records(pool, "rest")
    , System(pool, KeptRowSums::None)
  {
    this->Low.fill(std::numeric_limits<double>::max());
    this->High.fill(std::numeric_limits<double>::lowest());
  }

  /** Keeps the blocks in scratch files in `folder`; otherwise they stay in memory. */
  void useScratch(const ScratchFolder& folder, ScratchTraffic& traffic);

  // During the first pass:

  /** Vertex `i` is held and has this target. Called in ascending order, so early that a begin()
   * comes between it and close() of the vertex. */
  void hold(std::int64_t i, const double* target);
  void begin() override;
  void link(std::int32_t delta, double weight) override { this->System.link(delta, weight); }
  void unknown(double share, std::int32_t label, double rowSum) override
  {
    this->System.unknown(share, label, rowSum);
  }
  void close(const double* point, std::int64_t reach) override;
  void finish();

  // Afterwards:

  /** The diagonal of the bounding box of the positions at rest and the targets. */
  double extent() const;
  SystemRecords& system() { return this->System; }
  /** Restarts next() at the first block. */
  void startPass() { this->Records.startPass(); }
  /** The next block of a pass. */
  RestBlock next() { return RestBlock(this->Records.next()); }
  void endPass() { this->Records.endPass(); }
  /**
   * Adds to the displacements of vertices [first, first + count), any range, their start: the
   * positions at rest, or the targets of held vertices.
   */
  void addStart(std::int64_t first, std::int64_t count, double* values);
  /** Saves the blocks, which are in a scratch file. */
  void save(StateWriter& state);
  void load(StateReader& state);
  std::int64_t blocks() const { return (this->Vertices + RowBlock::Nodes - 1) / RowBlock::Nodes; }
  /** A block, in any order; without scratch files it may be modified in place. */
  RestBlock block(std::int64_t number)
  {
    this->Cached = -1;
    return RestBlock(this->Records.at(number));
  }

private:
  void enclose(const double* point);
  void pack();
  void cacheStart(std::int64_t number);

  VertexRecords Records;
  SystemRecords System;
  // Held vertices that are not closed, with stream indices as `node`. begin() moves those in Coming
  // to Waiting.
  std::deque<RestBlock::Held> Coming, Waiting;
  RestBlock::Header Open;
  std::vector<double> Points;
  std::vector<RestBlock::Held> Held;
  std::int64_t Vertices = 0;
  std::array<double, 3> Low, High;
  std::int64_t Cached = -1; // block of addStart()
  std::vector<double> CachedPoints;
};

} // namespace smg
