// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/ScratchStream.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** The component label of every vertex, in memory or in a scratch file, written once. */
class ComponentLabels
{
public:
  /** Vertices of a block; the last one may be shorter. */
  static constexpr std::size_t Block = 1024;

  /** Keeps the labels in a scratch file; else they stay in memory. */
  void useScratch(const std::filesystem::path& folder, IoStatistics& statistics);

  /** Appends the labels of the next vertices. */
  void append(std::span<const std::int32_t> labels);
  void finish();

  /** The labels of block `index`, valid until the next call. */
  std::span<const std::int32_t> block(std::int64_t index);
  std::int64_t vertices() const { return this->Count; }

private:
  /** Most blocks have one label only, which is stored once: block() repeats it. */
  void store(std::span<const std::int32_t> labels);

  std::optional<ScratchStream> Scratch;
  std::vector<std::int32_t> Labels; // all of them, or those of the current block
  std::int64_t Count = 0;
  std::int64_t Cached = -1;
};

} // namespace smg
