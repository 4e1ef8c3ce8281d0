// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"

#include "Solver/Core/Workers.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstring>
#include <system_error>
#include <utility>

namespace smg
{

InputFile::InputFile(std::filesystem::path path, ProgressFunction progress, std::string name)
  : Path(std::move(path))
  , Name(name.empty() ? this->Path.string() : std::move(name))
  , File(FileDescriptor::openForReading(this->Path))
  , Size(static_cast<std::size_t>(this->File.size()))
  , Reported(std::move(progress))
{
  if (this->Size == 0)
  {
    throw Error(this->Name + ": the file is empty.");
  }
}

std::string_view InputFile::move(std::size_t offset, std::size_t least)
{
  const std::size_t begin = std::min(offset, this->Size);
  const std::size_t wanted = std::min(std::max(least, WindowBytes), this->Size - begin);
  this->Window.resize(std::max(this->Window.size(), wanted));
  std::size_t kept = 0;
  if (begin >= this->Begin && begin < this->Begin + this->Used)
  {
    kept = std::min(this->Begin + this->Used - begin, wanted);
    std::memmove(this->Window.data(), this->Window.data() + (begin - this->Begin), kept);
  }
  this->File.read(static_cast<std::int64_t>(begin + kept),
    std::as_writable_bytes(std::span(this->Window).subspan(kept, wanted - kept)));
  this->Begin = begin;
  this->Used = wanted;
  this->Reached = begin;
  if (!Workers::isCaller())
  {
    this->poll();
  }
  return { this->Window.data(), wanted };
}

void InputFile::poll()
{
  this->Reported.update(static_cast<double>(this->Reached) / static_cast<double>(this->Size));
}

void InputFile::passed(std::size_t bytes)
{
  this->Passed = std::min(this->Size, this->Passed + bytes);
  this->Reported.update(static_cast<double>(this->Passed) / static_cast<double>(this->Size));
}

void InputFile::fail(std::size_t offset, const std::string& sentence) const
{
  throw Error(this->Name + ", byte " + std::to_string(offset) + ": " + sentence);
}

std::string countError(std::int64_t count, const std::string& what, std::size_t left)
{
  return std::to_string(count) + " cannot be " + what + ": the file has " + std::to_string(left) +
         " more bytes, it is truncated or the number is wrong";
}

std::filesystem::path nearbyFile(
  const std::filesystem::path& folder, const std::filesystem::path& name)
{
  std::error_code error;
  const std::filesystem::path root = std::filesystem::canonical(folder / ".", error);
  const std::filesystem::path file =
    error ? std::filesystem::path{} : std::filesystem::weakly_canonical(root / name, error);
  if (error || name.is_absolute() ||
      std::mismatch(root.begin(), root.end(), file.begin(), file.end()).first != root.end())
  {
    return {};
  }
  return file;
}

} // namespace smg
