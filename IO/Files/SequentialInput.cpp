// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/SequentialInput.h"

#include "IO/Files/LineEnds.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstring>

namespace smg
{

namespace
{

constexpr std::size_t InputBufferBytes = std::size_t(256) << 10;

} // namespace

SequentialInput::SequentialInput(const std::filesystem::path& path)
  : File(FileDescriptor::openForReading(path))
  , Size(this->File.size())
  , Buffer(InputBufferBytes)
{
}

void SequentialInput::moveTo(std::int64_t position)
{
  this->BufferOffset = position;
  this->Begin = this->End = 0;
}

void SequentialInput::fill(std::size_t count)
{
  if (this->End - this->Begin >= count)
  {
    return;
  }
  std::memmove(this->Buffer.data(), this->Buffer.data() + this->Begin, this->End - this->Begin);
  this->BufferOffset += std::int64_t(this->Begin);
  this->End -= this->Begin;
  this->Begin = 0;
  this->End += this->File.readSome(
    this->BufferOffset + std::int64_t(this->End), std::span(this->Buffer).subspan(this->End));
}

std::span<const std::byte> SequentialInput::peek(std::size_t count)
{
  this->fill(count);
  return std::span(this->Buffer).subspan(this->Begin, std::min(count, this->End - this->Begin));
}

bool SequentialInput::nextLine(std::string_view& line)
{
  const auto text = [this]
  {
    return std::string_view(
      reinterpret_cast<const char*>(this->Buffer.data()) + this->Begin, this->End - this->Begin);
  };
  if (this->Line == 0)
  {
    this->fill(MaxLine + 1);
    this->LineEnd = lineEndOf(text());
  }
  std::size_t length = text().find(this->LineEnd);
  if (length == std::string_view::npos)
  {
    this->fill(MaxLine + 1);
    length = std::min(text().find(this->LineEnd), text().size());
  }
  if (this->Begin == this->End)
  {
    return false;
  }
  this->Line++;
  if (length > MaxLine)
  {
    throw Error(this->name() + ": line " + std::to_string(this->Line) + " has more than " +
                std::to_string(MaxLine) + " characters: this is not a file of that kind.");
  }
  line = text().substr(0, length);
  this->Begin += std::min(length + 1, this->End - this->Begin);
  if (!line.empty() && line.back() == '\r')
  {
    line.remove_suffix(1);
  }
  return true;
}

} // namespace smg
