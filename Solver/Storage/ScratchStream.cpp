// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Storage/ScratchStream.h"

#include <nlohmann/json.hpp>

namespace smg
{

ScratchStream::~ScratchStream()
{
  this->Writer.reset();
  if (this->Reader)
  {
    this->Reader.reset();
    std::error_code ignored;
    std::filesystem::remove(this->generationPath(this->Generation), ignored);
  }
}

std::filesystem::path ScratchStream::generationPath(int generation) const
{
  return this->Path.string() + "." + std::to_string(generation);
}

void ScratchStream::startPass(bool rewrite)
{
  this->Next = this->Ahead = this->Requested = 0;
  this->readAhead();
  if (rewrite)
  {
    const TableSpec table{ "blocks", { ColumnSpec{ "block", ScalarType::UInt8, 0 } } };
    this->Writer = std::make_unique<BlockFileWriter>(this->generationPath(this->Generation + 1),
      std::vector{ table }, Codec::None, this->Statistics);
  }
}

/** Requests the next range of blocks when those of the last request begin to be used up. */
void ScratchStream::readAhead()
{
  if (this->Reader && this->Next >= this->Ahead && this->Requested < this->Reader->blocks(0))
  {
    this->Ahead = this->Requested;
    this->Requested = this->Reader->prefetch(0, this->Requested, ReadAheadBytes);
  }
}

void ScratchStream::append(std::span<const std::byte> block)
{
  this->Writer->append(0, 1, { &block, 1 });
}

std::size_t ScratchStream::bytes(std::int64_t index) const
{
  return this->Reader->columnBytes(0, index, 0);
}

std::size_t ScratchStream::nextBytes() const
{
  return this->bytes(this->Next);
}

void ScratchStream::read(std::int64_t index, std::span<std::byte> block)
{
  this->Reader->read(0, index, 0, block);
}

void ScratchStream::read(std::span<std::byte> block)
{
  this->read(this->Next, block);
  this->readAhead();
  ++this->Next;
}

void ScratchStream::endPass()
{
  if (!this->Writer)
  {
    return;
  }
  this->Writer->finish(nlohmann::json::object());
  this->Writer.reset();
  const std::filesystem::path old = this->generationPath(this->Generation);
  const bool hadReader = this->Reader != nullptr;
  this->Reader.reset();
  if (hadReader)
  {
    std::error_code ignored;
    std::filesystem::remove(old, ignored);
  }
  ++this->Generation;
  this->Reader =
    std::make_unique<BlockFileReader>(this->generationPath(this->Generation), this->Statistics);
}

} // namespace smg
