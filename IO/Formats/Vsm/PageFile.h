// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/IoStatistics.h"
#include "Solver/Storage/ScratchBlocks.h"
#include "Solver/Storage/ScratchFolder.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace smg
{

/** An unbounded sequence of pages of bytes, initially zero; a few are in memory, the others in an
 * unnamed scratch file, which is created only when the memory is exhausted. It is in `folder`, or,
 * if that is no open ScratchFolder, in one made there: the bytes of scratch files are counted. */
class PageFile
{
public:
  static constexpr std::size_t PageBytes = std::size_t(16) << 10;

  /** Keeps at most `memory` bytes of pages in memory, at least 4 pages. `folder` empty: the
   * system's temporary folder. */
  PageFile(std::filesystem::path folder, std::int64_t memory);

  /** The bytes of page `page`, valid until the next call. `change`: whether they will be modified.
   * Throws Error if the scratch file fails. */
  std::byte* page(std::int64_t page, bool change)
  {
    const bool isKnown = page < static_cast<std::int64_t>(this->SlotOfPage.size());
    const std::int32_t number = isKnown ? this->SlotOfPage[page] : Untouched;
    Slot& slot = this->Slots[number >= 0 ? number : this->load(page)];
    slot.used = true;
    slot.changed = slot.changed || change;
    return slot.bytes.get();
  }

  /** Releases the pages below `page`, which must not be accessed any more. */
  void discardBelow(std::int64_t page);

private:
  enum : std::int32_t
  {
    Untouched = -1,
    OnDisk = -2,
    Discarded = -3
  };
  struct Slot
  {
    std::unique_ptr<std::byte[]> bytes;
    std::int64_t page = -1;
    bool changed = false;
    bool used = false; ///< since the last visit of the hand
  };

  /** Brings a page into memory; returns its slot. */
  std::int32_t load(std::int64_t page);
  std::int32_t makeRoom();

  void createFile();

  std::filesystem::path Folder;
  IoStatistics Traffic;
  std::unique_ptr<ScratchFolder> Own; ///< if one had to be made
  std::optional<ScratchBlocks> File;
  std::size_t MaxSlots;
  std::vector<Slot> Slots;
  std::vector<std::int32_t> Vacant;
  std::vector<std::int32_t> SlotOfPage; ///< or one of the above
  std::size_t Hand = 0;
  std::int64_t FirstKept = 0;
};

} // namespace smg
