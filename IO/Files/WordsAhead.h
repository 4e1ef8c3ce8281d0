// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/OrderedJobs.h"
#include "IO/External/Workspace.h"
#include "IO/Files/CharacterKinds.h"
#include "IO/Files/InputFile.h"
#include "Solver/Memory/Reservation.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace smg
{

/** A word of a text block, as a number if it is one. */
struct TextWord
{
  enum Kind : std::uint8_t
  {
    Other,
    Integer, ///< which is the same as a double
    Real     ///< finite
  };

  std::uint32_t begin;  ///< in the block
  std::uint32_t length; ///< bytes
  std::uint32_t line;   ///< the line ends of the block before it
  Kind kind;
  union
  {
    std::int64_t integer;
    double real;
  };
};

/** Text up to a line's end, and the words at its begin: all of them, unless they are very many. */
struct TextBlock
{
  std::vector<char> text;
  std::vector<TextWord> words;
};

/**
 * The lines of a text in blocks, whose words other threads find and convert to numbers while the
 * owner takes the blocks before them.
 */
class WordsAhead
{
public:
  static constexpr std::size_t BlockBytes = std::size_t(64) << 10;

  /** Whether there are threads and memory for it. */
  static bool isPossible(const Workspace& workspace)
  {
    return workspace.itemsAtOnce(MemoryBytes) > 1;
  }

  /** From `offset` on, which is not inside of a word or a comment. The file must outlive it; its
   * window moves. */
  WordsAhead(InputFile& file, Workspace& workspace, CharacterKinds kinds, std::size_t offset);

  /** The next block, valid until the next call; null at the end of the file, or where the rest of
   * a line is longer than a block. Throws Error, Cancelled. */
  const TextBlock* next();

private:
  /** The maximum number of words that are found in a block: as lines of a mesh have. */
  static constexpr std::size_t MostWords = BlockBytes / 4;
  static constexpr std::int64_t MemoryBytes = BlockBytes + MostWords * sizeof(TextWord);

  static void findWords(TextBlock& block, const CharacterKinds& kinds);
  /** Reads the text of the next block; returns whether there is one. */
  bool read();

  InputFile& File;
  std::size_t Offset;
  const std::int64_t AtOnce; ///< blocks
  Reservation Reserved;
  TextBlock Current;
  OrderedJobs<TextBlock> Blocks;
};

} // namespace smg
