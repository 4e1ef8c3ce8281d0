// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/VertexRecords.h"

namespace smg
{

void VertexRecords::useScratch(const ScratchFolder& folder, ScratchTraffic& traffic)
{
  this->Scratch.emplace(folder, this->Name, traffic.add(this->Name));
  this->Scratch->startPass(true);
}

void VertexRecords::append(Buffer record)
{
  if (this->Scratch)
  {
    this->Scratch->append(record.bytes());
    return;
  }
  this->Resident.push_back(std::move(record));
}

void VertexRecords::finish()
{
  if (this->Scratch)
  {
    this->Scratch->endPass();
  }
}

void VertexRecords::startPass()
{
  this->Next = 0;
  if (this->Scratch)
  {
    this->Scratch->startPass(false);
  }
}

auto VertexRecords::next() -> Record
{
  if (!this->Scratch)
  {
    return Record(this->Resident[this->Next++].bytes());
  }
  Buffer buffer(*this->Memory, this->Scratch->nextBytes());
  this->Scratch->read(buffer.bytes());
  return Record(std::move(buffer));
}

void VertexRecords::endPass()
{
  if (this->Scratch)
  {
    this->Scratch->endPass();
  }
}

auto VertexRecords::at(std::int64_t block) -> Record
{
  if (!this->Scratch)
  {
    return Record(this->Resident[static_cast<std::size_t>(block)].bytes());
  }
  Buffer buffer(*this->Memory, this->Scratch->bytes(block));
  this->Scratch->read(block, buffer.bytes());
  return Record(std::move(buffer));
}

void VertexRecords::save(StateWriter& state)
{
  this->Scratch->save(state);
}

void VertexRecords::load(
  StateReader& state, std::int64_t blocks, const ScratchStream::BlockCheck& check)
{
  this->Scratch->load(state, blocks, check);
}

} // namespace smg
