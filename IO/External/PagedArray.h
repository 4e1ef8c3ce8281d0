// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/BlockStore.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Files/ScratchFolder.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace smg
{

/**
 * An unbounded sequence of pages of bytes, initially zero. A few are in memory, the others in an
 * unnamed scratch file, which is created only when the memory is exhausted. It lies in `folder` if
 * that is an open ScratchFolder, and otherwise in one made there, so that its bytes are counted.
 *
 * Its tables take about 1/200 of the bytes of the pages, from the first that is not discarded to
 * the last. Pages in memory give way to them, down to four.
 */
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
    const std::int64_t place = page - this->FirstPage;
    const bool isKnown = place < static_cast<std::int64_t>(this->States.size());
    const std::int32_t number = isKnown ? this->States[place] : Untouched;
    Slot& slot = this->Slots[number >= 0 ? number : this->load(page)];
    slot.used = true;
    slot.changed = slot.changed || change;
    return slot.bytes.get();
  }

  /** Releases the pages below `page`, which must not be accessed any more. */
  void discardBelow(std::int64_t page);

private:
  /** The state of a page is the number of its slot, or this value, or that of onDisk(). */
  static constexpr std::int32_t Untouched = -1;
  /** The state of a page that is in a block of the file; it is its own inverse. */
  static constexpr std::int32_t onDisk(std::int32_t block) { return -2 - block; }

  struct Slot
  {
    std::unique_ptr<std::byte[]> bytes;
    std::int64_t page = -1;  ///< none
    std::int32_t block = -1; ///< of the page in the file; none
    bool changed = false;    ///< since it was there
    bool used = false;       ///< since the hand has last passed
  };

  /** Brings a page into memory; returns its slot. */
  std::int32_t load(std::int64_t page);
  std::int32_t makeRoom();
  /** Writes the page of a slot, if that is needed, and forgets it there. */
  void evict(Slot& slot);
  std::int64_t maxSlots() const;
  std::int32_t& stateOf(std::int64_t page) { return this->States[page - this->FirstPage]; }

  void createFile();

  std::filesystem::path Folder;
  IoStatistics Traffic;
  std::unique_ptr<ScratchFolder> Own; ///< if it had to be made
  std::optional<BlockStore> File;
  std::int64_t Memory;
  std::vector<Slot> Slots;
  std::vector<std::int32_t> Vacant;
  std::vector<std::int32_t> States; ///< of the pages from FirstPage on
  std::int64_t FirstPage = 0;
  std::vector<std::int32_t> SpareBlocks; ///< of the file
  std::int32_t Blocks = 0;               ///< number of blocks that the file has had
  std::size_t Hand = 0;
  std::int64_t FirstKept = 0; ///< the first page that is not discarded
};

/** An unbounded array of values, initially zero, in bounded memory: the rest is in a scratch file.
 * Fast if consecutive accesses are close to each other. */
template <class T>
class PagedArray
{
  static_assert(std::is_trivially_copyable_v<T> && std::has_single_bit(sizeof(T)));

public:
  /** Scratch files go to `folder` (see PageFile); at most `memory` bytes of the values are in
   * memory. */
  PagedArray(std::filesystem::path folder, std::int64_t memory)
    : Pages(std::move(folder), memory)
  {
  }

  /** The value at index `i`, for modification; valid until another index is accessed. */
  T& at(std::int64_t i) { return *this->visit(i, true); }

  /** The value at index `i`. */
  T get(std::int64_t i) { return *this->visit(i, false); }

  /** Declares that no index below `i` will be accessed again. */
  void discardBelow(std::int64_t i)
  {
    if (i / PerPage > this->FirstPage)
    {
      this->FirstPage = i / PerPage;
      this->Pages.discardBelow(this->FirstPage);
      this->Page = -1;
    }
  }

private:
  static constexpr std::int64_t PerPage = PageFile::PageBytes / sizeof(T);

  T* visit(std::int64_t i, bool change)
  {
    const std::int64_t page = i / PerPage;
    if (page != this->Page || (change && !this->Changing))
    {
      this->Values = reinterpret_cast<T*>(this->Pages.page(page, change));
      this->Page = page;
      this->Changing = change;
    }
    return this->Values + i % PerPage;
  }

  PageFile Pages;
  std::int64_t FirstPage = 0;
  std::int64_t Page = -1; ///< the last accessed page
  bool Changing = false;  ///< whether it was accessed for modification
  T* Values = nullptr;
};

} // namespace smg
