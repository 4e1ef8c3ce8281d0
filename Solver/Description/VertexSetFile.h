// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/ScratchStream.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace smg
{

/** A set of the vertices of a mesh stream in a scratch file without a name, one bit a vertex. */
class VertexSetFile
{
public:
  /** `folder`: empty: the system's temporary folder. */
  explicit VertexSetFile(const std::filesystem::path& folder);

  /** Adds the next vertices: 1 for those of the set, else 0. */
  void append(std::span<const std::uint8_t> selected);
  /** To be called behind the last one. */
  void finish();

  /** Goes back to the first vertex. */
  void rewind();
  /** Says of the next vertices what append() was told. */
  void read(std::span<std::uint8_t> selected);

private:
  static constexpr std::size_t BlockBytes = std::size_t(64) << 10;

  IoStatistics Statistics;
  ScratchStream Stream;
  std::vector<std::byte> Bits; ///< of the block that is being written or read
  std::size_t Next = 0;        ///< place of the next vertex in it
};

} // namespace smg
