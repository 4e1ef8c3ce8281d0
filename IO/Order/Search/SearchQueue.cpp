// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/SearchQueue.h"

#include <algorithm>
#include <utility>

namespace smg
{

SearchQueue::SearchQueue(Workspace& workspace, std::size_t bytes)
  : Space(workspace)
  , Half(std::max<std::size_t>(16, bytes / 2 / sizeof(std::uint32_t)))
  , Front(workspace.pool(), this->Half * sizeof(std::uint32_t))
  , Back(workspace.pool(), this->Half * sizeof(std::uint32_t))
{
}

void SearchQueue::turn()
{
  std::swap(this->Front, this->Back);
  this->FrontBegin = 0;
  this->FrontEnd = std::exchange(this->BackEnd, 0);
}

void SearchQueue::spill()
{
  if (this->FrontBegin == this->FrontEnd && this->FileBegin == this->File.size())
  {
    this->turn();
    return;
  }
  if (!this->File.isOpen())
  {
    this->File.create(this->Space.folder());
  }
  this->File.append(this->Back.bytes());
  this->Space.traffic().bytesWritten += std::int64_t(this->Back.size());
  this->BackEnd = 0;
}

void SearchQueue::refill()
{
  if (this->FileBegin == this->File.size())
  {
    this->turn();
    return;
  }
  this->File.read(this->FileBegin, this->Front.bytes());
  this->FileBegin += std::int64_t(this->Front.size());
  this->Space.traffic().bytesRead += std::int64_t(this->Front.size());
  this->FrontBegin = 0;
  this->FrontEnd = this->Half;
  if (this->FileBegin == this->File.size())
  {
    this->FileBegin = 0;
    this->File.restart();
  }
}

void SearchQueue::clear()
{
  this->FrontBegin = this->FrontEnd = this->BackEnd = 0;
  this->Size = this->FileBegin = 0;
  this->File.restart();
}

} // namespace smg
