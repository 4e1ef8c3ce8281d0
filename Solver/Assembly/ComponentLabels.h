// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Components.h"
#include "Solver/Files/ScratchStream.h"
#include "Solver/Files/State.h"
#include "Solver/Memory/Pool.h"
#include "Solver/Memory/Ring.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** The component label of every vertex, and its mass if the component may be free. Written once,
 * kept in memory or in a scratch file. */
class SMG_EXPORT ComponentLabels
{
public:
  /** The number of vertices of a block; the last one may be shorter. */
  static constexpr std::size_t Block = 1024;
  // Instead of a label: for a vertex of no component, and for one that nothing determines.
  static constexpr std::int32_t None = -1, Undetermined = -2;

  /** The data of the vertices of a block. */
  struct Entries
  {
    std::span<const std::int32_t> labels;
    /** Empty if all their components had a constraint when the block was complete. */
    std::span<const double> masses;
  };

  explicit ComponentLabels(const Components& components)
    : Parts(components)
  {
  }

  /** Keeps the labels in a scratch file; otherwise they stay in memory. */
  void useScratch(const ScratchFolder& folder, IoStatistics& statistics);

  /** Appends the next vertices: their labels, None or Undetermined, and lumped masses. */
  void append(std::span<const std::int32_t> labels, std::span<const double> masses);
  void finish();

  /** Block `index`, valid until the next call. */
  Entries block(std::int64_t index);
  /** Saves the labels, which are in a scratch file and finished. */
  void save(StateWriter& state);
  /** Restores them; the components must be complete. */
  void load(StateReader& state);

  std::int64_t vertices() const { return this->Count; }

private:
  void store(std::size_t first, std::size_t count);
  std::size_t blockCount(std::int64_t index) const;
  void decode(std::span<const std::byte> record, std::size_t count);

  const Components& Parts;
  std::optional<ScratchStream> Scratch;
  std::vector<std::vector<std::byte>> Stored; // the blocks, without a scratch file
  std::vector<std::int32_t> Labels;           // of the incomplete block, or of block()
  std::vector<double> Masses;
  std::vector<std::byte> Record;
  std::int64_t Count = 0;
  std::int64_t Cached = -1;
};

/** The components of open vertices, according to the cells so far. */
class SMG_EXPORT OpenLabels
{
public:
  /** Cells that connect nothing, when there are `most` labels, get the first one. */
  OpenLabels(Pool& pool, Components& components,
    std::int32_t most = std::numeric_limits<std::int32_t>::max())
    : Parts(components)
    , Labels(pool)
    , Most(most)
  {
  }

  /** Sets the number of vertices so far; new ones have no component. */
  void extend(std::int64_t vertices);
  void release(std::int64_t first) { this->Labels.release(first); }
  /** Joins the corners of a cell. */
  void join(const std::int64_t* corners, int count)
  {
    const std::int32_t label = this->Labels[corners[0]];
    bool joined = label >= 0;
    for (int k = 1; k < count; ++k)
    {
      joined = joined && this->Labels[corners[k]] == label;
    }
    if (!joined)
    {
      this->joinOthers(corners, count);
    }
  }
  /** A label of the component of an open vertex; -1: none. It depends only on the cells of the
   * vertex and on cells before them in the stream, not on blocks. */
  std::int32_t label(std::int64_t i) const { return this->Labels[i]; }

protected:
  Components& Parts;
  Ring<std::int32_t> Labels; // of the first component of a vertex, or -1

private:
  void joinOthers(const std::int64_t* corners, int count);

  std::int32_t Most;
};

/** Those of the assembly. */
class SMG_EXPORT OpenComponents : public OpenLabels
{
public:
  /** `labels` receives the component of each closed vertex. */
  OpenComponents(Pool& pool, Components& components, ComponentLabels& labels)
    : OpenLabels(pool, components)
    , Closed(labels)
  {
  }

  /** Closes vertex i, the next one, with this mass; returns the root of its component, or -1. */
  std::int32_t close(std::int64_t i, double mass);
  /** close() for a vertex that nothing determines. */
  std::int32_t closeUndetermined(std::int64_t i);
  /** Passes on the closed vertices. */
  void flush();

private:
  ComponentLabels& Closed;
  std::vector<std::int32_t> LabelBatch;
  std::vector<double> MassBatch;
};

} // namespace smg
