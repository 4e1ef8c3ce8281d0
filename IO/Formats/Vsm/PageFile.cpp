// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/PageFile.h"

#include "Solver/Storage/ScratchAccount.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

namespace smg
{

PageFile::PageFile(std::filesystem::path folder, std::int64_t memory)
  : Folder(std::move(folder))
  , MaxSlots(std::max<std::int64_t>(4, memory / std::int64_t(PageBytes)))
{
}

std::int32_t PageFile::load(std::int64_t page)
{
  if (page >= static_cast<std::int64_t>(this->SlotOfPage.size()))
  {
    this->SlotOfPage.resize(page + 1, Untouched);
  }
  const std::int32_t state = this->SlotOfPage[page];
  const std::int32_t number = this->makeRoom();
  Slot& slot = this->Slots[number];
  if (state == OnDisk)
  {
    this->File->read(page, std::as_writable_bytes(std::span(slot.bytes.get(), PageBytes)));
  }
  else
  {
    std::memset(slot.bytes.get(), 0, PageBytes);
  }
  slot.page = page;
  // A page that was never written must be written even if it is only read.
  slot.changed = state != OnDisk;
  this->SlotOfPage[page] = number;
  return number;
}

std::int32_t PageFile::makeRoom()
{
  if (!this->Vacant.empty())
  {
    const std::int32_t number = this->Vacant.back();
    this->Vacant.pop_back();
    return number;
  }
  if (this->Slots.size() < this->MaxSlots)
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
  Slot& slot = this->Slots[number];
  if (slot.changed)
  {
    if (!this->File)
    {
      this->createFile();
    }
    this->File->write(slot.page, std::span(slot.bytes.get(), PageBytes));
  }
  this->SlotOfPage[slot.page] = OnDisk;
  return number;
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
  const auto end = std::min(page, static_cast<std::int64_t>(this->SlotOfPage.size()));
  for (; this->FirstKept < end; this->FirstKept++)
  {
    const std::int32_t state = std::exchange(this->SlotOfPage[this->FirstKept], Discarded);
    if (state >= 0)
    {
      this->Slots[state].changed = false;
      this->Slots[state].used = false;
      this->Vacant.push_back(state);
    }
  }
}

} // namespace smg
