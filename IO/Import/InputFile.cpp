// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/InputFile.h"

#include "Solver/Core/Error.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace smg
{

namespace
{
constexpr std::size_t StepBytes = std::size_t(8) << 20;
}

InputFile::InputFile(std::filesystem::path path, ProgressFunction progress)
  : Path(std::move(path))
  , Reported(std::move(progress))
{
  const int descriptor = ::open(this->Path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
  {
    throw Error(this->Path.string() + ": cannot be opened: " + std::strerror(errno));
  }
  struct stat status = {};
  std::string problem;
  if (::fstat(descriptor, &status) != 0)
  {
    problem = std::string("cannot be read: ") + std::strerror(errno);
  }
  else if (!S_ISREG(status.st_mode))
  {
    problem = "is not a regular file";
  }
  else if (status.st_size == 0)
  {
    problem = "is empty";
  }
  else
  {
    this->Size = static_cast<std::size_t>(status.st_size);
    void* data = ::mmap(nullptr, this->Size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (data == MAP_FAILED)
    {
      problem = std::string("cannot be mapped into memory: ") + std::strerror(errno);
    }
    else
    {
      this->Data = static_cast<const char*>(data);
      ::madvise(data, this->Size, MADV_SEQUENTIAL);
    }
  }
  ::close(descriptor);
  if (!problem.empty())
  {
    throw Error(this->Path.string() + ": the file " + problem);
  }
}

InputFile::~InputFile()
{
  if (this->Data)
  {
    ::munmap(const_cast<char*>(this->Data), this->Size);
  }
}

void InputFile::step(std::size_t offset)
{
  this->Reported.update(static_cast<double>(offset) / static_cast<double>(this->Size));
  const std::size_t release = offset / StepBytes * StepBytes;
  if (release > this->Released)
  {
    ::madvise(
      const_cast<char*>(this->Data) + this->Released, release - this->Released, MADV_DONTNEED);
    this->Released = release;
  }
  this->NextStep = release + StepBytes;
}

void InputFile::rewind()
{
  this->Released = 0;
  this->NextStep = 0;
}

void InputFile::fail(std::size_t offset, const std::string& sentence) const
{
  throw Error(this->Path.string() + ", byte " + std::to_string(offset) + ": " + sentence);
}

} // namespace smg
