// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/PagedArray.h"

#include "Solver/Files/ScratchAccount.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

// An array of any length in a fixed amount of memory: pages in slots, the others in the blocks of a
// scratch file, and a table with the state of each page. CLOCK chooses what is evicted. A page that
// was never written is zero and takes no room on disk; one that has not changed since it was read
// is not written again.

namespace smg
{

PageFile::PageFile(std::filesystem::path folder, std::int64_t memory)
  : Folder(std::move(folder))
  , Memory(memory)
{
}

std::int64_t PageFile::maxSlots() const
{
  constexpr std::int64_t Least = 4;
  // The tables grow with the array, and count in its memory: pages give way to them.
  const auto tables = static_cast<std::int64_t>(this->States.capacity() * sizeof(std::int32_t)) +
                      this->Blocks * BlockStore::TableBytes;
  return std::max(Least, (this->Memory - tables) / std::int64_t(PageBytes));
}

std::int32_t PageFile::load(std::int64_t page)
{
  if (page - this->FirstPage >= static_cast<std::int64_t>(this->States.size()))
  {
    this->States.resize(page - this->FirstPage + 1, Untouched);
  }
  const std::int32_t number = this->makeRoom();
  Slot& slot = this->Slots[number];
  // After makeRoom(), which changes the states of other pages.
  const std::int32_t state = std::exchange(this->stateOf(page), number);
  if (state != Untouched)
  {
    slot.block = onDisk(state);
    this->File->read(slot.block, std::as_writable_bytes(std::span(slot.bytes.get(), PageBytes)));
  }
  else
  {
    std::memset(slot.bytes.get(), 0, PageBytes);
  }
  slot.page = page;
  return number;
}

std::int32_t PageFile::makeRoom()
{
  // The tables may have grown since the last call, and left room for fewer slots.
  while (std::ssize(this->Slots) > this->maxSlots())
  {
    const auto last = static_cast<std::int32_t>(this->Slots.size()) - 1;
    this->Slots.back().page >= 0 ? this->evict(this->Slots.back())
                                 : void(std::erase(this->Vacant, last));
    this->Slots.pop_back();
    this->Hand %= this->Slots.size();
  }
  if (!this->Vacant.empty())
  {
    const std::int32_t number = this->Vacant.back();
    this->Vacant.pop_back();
    return number;
  }
  if (std::ssize(this->Slots) < this->maxSlots())
  {
    this->Slots.emplace_back().bytes = std::make_unique<std::byte[]>(PageBytes);
    return static_cast<std::int32_t>(this->Slots.size()) - 1;
  }
  // A slot that was used since the hand came by is passed once.
  while (std::exchange(this->Slots[this->Hand].used, false))
  {
    this->Hand = (this->Hand + 1) % this->Slots.size();
  }
  const auto number = static_cast<std::int32_t>(this->Hand);
  this->Hand = (this->Hand + 1) % this->Slots.size();
  this->evict(this->Slots[number]);
  return number;
}

void PageFile::evict(Slot& slot)
{
  if (slot.changed)
  {
    if (!this->File)
    {
      this->createFile();
    }
    // A page keeps its block in the file as long as it exists; blocks of discarded pages are used
    // again.
    if (slot.block < 0 && this->SpareBlocks.empty())
    {
      slot.block = this->Blocks++;
    }
    else if (slot.block < 0)
    {
      slot.block = this->SpareBlocks.back();
      this->SpareBlocks.pop_back();
    }
    this->File->write(slot.block, std::span(slot.bytes.get(), PageBytes));
  }
  this->stateOf(slot.page) = slot.block < 0 ? Untouched : onDisk(slot.block);
  slot = { std::move(slot.bytes) };
}

void PageFile::createFile()
{
  // The folder is not a scratch folder: one is made in it, so that the bytes are counted and
  // removed.
  if (!ScratchAccount::of(this->Folder))
  {
    this->Own = std::make_unique<ScratchFolder>(this->Folder);
  }
  const std::filesystem::path& folder = this->Own ? this->Own->path() : this->Folder;
  this->File.emplace(folder / "scratch file", this->Traffic);
}

void PageFile::discardBelow(std::int64_t page)
{
  const auto end = std::min(page, this->FirstPage + static_cast<std::int64_t>(this->States.size()));
  for (; this->FirstKept < end; this->FirstKept++)
  {
    const std::int32_t state = std::exchange(this->stateOf(this->FirstKept), Untouched);
    std::int32_t block = state < Untouched ? onDisk(state) : -1;
    if (state >= 0)
    {
      // The memory of the slot stays for another page.
      block = this->Slots[state].block;
      this->Slots[state] = { std::move(this->Slots[state].bytes) };
      this->Vacant.push_back(state);
    }
    if (block >= 0)
    {
      this->SpareBlocks.push_back(block);
    }
  }
  // States are moved only when more than half of them are of discarded pages, so each is moved
  // about once.
  if (const std::int64_t dead = this->FirstKept - this->FirstPage;
      dead > std::ssize(this->States) / 2)
  {
    this->States.erase(this->States.begin(), this->States.begin() + dead);
    this->FirstPage = this->FirstKept;
  }
}

} // namespace smg
