// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/KnownLinks.h"
#include "Solver/Assembly/RowAssembly.h"
#include "Solver/Files/ScratchStream.h"
#include "Solver/Multigrid/Cycle/RowBlock.h"

#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/**
 * The data of up to RowBlock::Nodes consecutive vertices that a deformation needs besides their
 * rows: the positions at rest, the targets of held vertices, and the edges to held neighbours,
 * which the rows omit.
 */
class RestBlock
{
public:
  struct Header
  {
    std::int64_t first = 0;
    std::int32_t nodes = 0;
    std::int32_t held = 0, links = 0;
    /** The largest neighbour in the mesh, including held ones, of nodes 0 .. end of the group. */
    std::array<std::int64_t, RowBlock::Groups> reach{};
  };
  struct Held
  {
    std::array<double, 3> target;
    std::int64_t node; ///< counted from the first node of the block
  };
  /** An edge from a free node to a held neighbour. */
  using Link = KnownLink<float>;

  explicit RestBlock(Buffer buffer)
    : Bytes(std::move(buffer))
    , Data(this->Bytes.data())
  {
  }
  /** A view of the same bytes, which this block owns. */
  RestBlock view() const { return RestBlock(this->Data); }

  static std::size_t bytes(const Header& h)
  {
    return sizeof(Header) + static_cast<std::size_t>(h.nodes) * 3 * sizeof(double) +
           static_cast<std::size_t>(h.held) * sizeof(Held) +
           static_cast<std::size_t>(h.links) * sizeof(Link);
  }

  Header& header() { return *reinterpret_cast<Header*>(this->Data); }
  const Header& header() const { return *reinterpret_cast<const Header*>(this->Data); }
  std::int64_t first() const { return this->header().first; }
  std::int64_t end() const { return this->header().first + this->header().nodes; }
  /** x, y, z of each node. */
  std::span<double> points() const
  {
    return { reinterpret_cast<double*>(this->Data + sizeof(Header)),
      static_cast<std::size_t>(this->header().nodes) * 3 };
  }
  /** By ascending node. */
  std::span<Held> held() const
  {
    return { reinterpret_cast<Held*>(this->points().data() + this->points().size()),
      static_cast<std::size_t>(this->header().held) };
  }
  /** By ascending node and neighbour. */
  std::span<Link> links() const
  {
    return { reinterpret_cast<Link*>(this->held().data() + this->held().size()),
      static_cast<std::size_t>(this->header().links) };
  }

private:
  explicit RestBlock(std::byte* data)
    : Data(data)
  {
  }

  Buffer Bytes;
  std::byte* Data;
};

/** The mesh at rest and its targets, in blocks, written in the first pass to scratch files or
 * memory. */
class RestShape : public RowListener
{
public:
  explicit RestShape(Pool& pool)
    : Owner(pool)
  {
    this->Low.fill(std::numeric_limits<double>::max());
    this->High.fill(std::numeric_limits<double>::lowest());
  }

  /** Keeps the blocks in a scratch file in `folder`; otherwise they stay in memory. */
  void useScratch(const ScratchFolder& folder, IoStatistics& statistics);

  // During the first pass:

  /** Vertex `i` is held and has this target. Called in ascending order, so early that a begin()
   * comes between it and close() of the vertex. */
  void hold(std::int64_t i, const double* target);
  void begin() override;
  void link(std::int32_t delta, double weight) override;
  void close(const double* point, std::int64_t reach) override;
  void finish();

  // Afterwards:

  /** The diagonal of the bounding box of the positions at rest and the targets. */
  double extent() const;
  /** Restarts next() at the first block. */
  void startPass();
  /** The next block of a pass. */
  RestBlock next();
  void endPass();
  /**
   * Adds to the displacements of vertices [first, first + count), any range, their start: the
   * positions at rest, or the targets of held vertices.
   */
  void addStart(std::int64_t first, std::int64_t count, double* values);
  /** Saves the blocks, which are in a scratch file. */
  void save(StateWriter& state);
  void load(StateReader& state);
  /** The blocks, without scratch files. */
  std::deque<RestBlock>& blocks() { return this->Blocks; }

private:
  void enclose(const double* point);
  void pack();
  void cacheStart(std::int64_t number);

  Pool& Owner;
  std::optional<ScratchStream> Scratch;
  std::deque<RestBlock> Blocks;
  // Held vertices that are not closed, with stream indices as `node`. begin() moves those in Coming
  // to Waiting.
  std::deque<RestBlock::Held> Coming, Waiting;
  RestBlock::Header Open;
  std::vector<double> Points;
  std::vector<RestBlock::Held> Held;
  std::vector<RestBlock::Link> Links;
  std::int64_t Vertices = 0;
  std::array<double, 3> Low, High;
  std::size_t NextBlock = 0;
  std::int64_t Cached = -1; // block of addStart()
  std::vector<double> CachedPoints;
};

} // namespace smg
