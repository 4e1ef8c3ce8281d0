// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/Components.h"
#include "Solver/Files/ScratchStream.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** The component label of every vertex, and its mass if the component may be free, in memory or in
 * a scratch file, written once. */
class SMG_EXPORT ComponentLabels
{
public:
  /** The number of vertices of a block; the last one may be shorter. */
  static constexpr std::size_t Block = 1024;
  // Instead of a label: a vertex of no component, and one that nothing determines.
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

} // namespace smg
