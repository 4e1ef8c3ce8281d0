// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/PagedArray.h"

#include "Solver/Files/ScratchAccount.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

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
  const auto tables = static_cast<std::int64_t>(this->States.capacity() * sizeof(std::int32_t)) +
                      this->Blocks * ScratchBlocks::TableBytes;
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
  // The tables may have grown.
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
      block = this->Slots[state].block;
      this->Slots[state] = { std::move(this->Slots[state].bytes) };
      this->Vacant.push_back(state);
    }
    if (block >= 0)
    {
      this->SpareBlocks.push_back(block);
    }
  }
  // States are moved only when half of them are of discarded pages: amortised once per page.
  if (const std::int64_t dead = this->FirstKept - this->FirstPage;
      dead > std::ssize(this->States) / 2)
  {
    this->States.erase(this->States.begin(), this->States.begin() + dead);
    this->FirstPage = this->FirstKept;
  }
}

} // namespace smg
