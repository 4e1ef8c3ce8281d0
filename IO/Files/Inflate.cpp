// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/Inflate.h"

#include "Solver/Files/FileDescriptor.h"
#include "Solver/Memory/Buffer.h"
#include "Solver/Memory/Pool.h"
#include "smg/Error.h"

#include <algorithm>
#include <memory>
#include <span>

namespace smg
{

namespace
{

/** Inflates a file from begin to end. */
class FileInflater
{
public:
  FileInflater(InputFile& file, Workspace& workspace, const std::filesystem::path& to)
    : File(file)
    , Space(workspace)
    , Chunk(workspace.pool(), std::size_t(256) << 10)
    , Out(FileDescriptor::createBeside(to))
    , Kind(compressionOf(file.at(0, MemberStartBytes)))
    , Members(makeDecompressor(file.at(0, MemberStartBytes), workspace.available()))
    , OfMembers(workspace.pool())
  {
  }
  FileInflater(const FileInflater&) = delete;
  FileInflater& operator=(const FileInflater&) = delete;

  void run()
  {
    for (std::size_t offset = 0; offset < this->File.size();)
    {
      this->Members->setInput(this->File.at(offset));
      const std::size_t bytes = this->Members->input().size();
      this->inflateInput(offset + bytes);
      offset += bytes - this->Members->input().size();
      if (this->Members->memberEnded() && !this->startMember(offset))
      {
        break;
      }
    }
    if (!this->Members->memberEnded())
    {
      this->File.fail(this->File.size(), "the compressed data do not end: the file is truncated");
    }
  }

  void renameTo(const std::filesystem::path& path) { this->Out.renameTo(path); }

private:
  /** Inflates the input, which ends at offset `end` of the file, up to its end or that of the
   * member. */
  void inflateInput(std::size_t end)
  {
    std::size_t written = 0;
    do
    {
      written = this->Members->step(this->Chunk.bytes());
      if (!this->Members->problem().empty())
      {
        this->File.fail(end - this->Members->input().size(), this->Members->problem());
      }
      // What a member takes is known with its first bytes, and within the limit.
      this->OfMembers.resize(this->Members->memory());
      this->Out.write(this->Written, this->Chunk.bytes().first(written));
      this->Written += static_cast<std::int64_t>(written);
      this->Space.traffic().bytesWritten += static_cast<std::int64_t>(written);
      // A small input can have a large output.
      this->Space.poll();
    } while (!this->Members->memberEnded() && written == this->Chunk.size());
  }

  /** Starts the member at `offset` or, of xz, behind padding, and moves there; returns false if
   * only padding follows. */
  bool startMember(std::size_t& offset)
  {
    const std::size_t begin = this->endOfZeros(offset);
    if (begin == this->File.size())
    {
      return false;
    }
    constexpr std::size_t Padding = 4; // zeros come in such groups between streams of xz
    const bool isPadded = this->Kind == Compression::Xz && (begin - offset) % Padding == 0;
    const std::string_view start = this->File.at(begin, MemberStartBytes);
    if ((begin > offset && !isPadded) || compressionOf(start) != this->Kind)
    {
      this->File.fail(offset, "something comes after the compressed data");
    }
    this->Members->startMember(start);
    offset = begin;
    return true;
  }

  /** The offset of the first byte from `offset` on that is not zero, or of the end of the file. */
  std::size_t endOfZeros(std::size_t offset)
  {
    while (offset < this->File.size())
    {
      const std::string_view bytes = this->File.at(offset);
      const std::size_t zeros = std::min(bytes.find_first_not_of('\0'), bytes.size());
      offset += zeros;
      if (zeros < bytes.size())
      {
        break;
      }
    }
    return offset;
  }

  InputFile& File;
  Workspace& Space;
  Buffer Chunk;
  FileDescriptor Out;
  std::int64_t Written = 0;
  const Compression Kind;
  const std::unique_ptr<Decompressor> Members;
  Reservation OfMembers; ///< the memory of the current one
};

} // namespace

void inflateFile(InputFile& file, Workspace& workspace, const std::filesystem::path& to)
{
  FileInflater inflater(file, workspace, to);
  inflater.run();
  inflater.renameTo(to);
}

InflatedFile::InflatedFile(InputFile& file, Workspace& workspace, const char* name)
  : Path(workspace.folder() / name)
{
  inflateFile(file, workspace, this->Path);
}

InflatedFile::~InflatedFile()
{
  FileDescriptor::removeClosed(this->Path);
}

std::string inflateStart(std::string_view bytes, std::size_t most)
{
  // The strongest usual settings of xz and zstd. It is hardly touched, for the few bytes here.
  constexpr std::int64_t Memory = std::int64_t(129) << 20;
  const Compression kind = compressionOf(bytes);
  const std::unique_ptr<Decompressor> members = makeDecompressor(bytes, Memory);
  members->setInput(bytes);
  std::string start(most, '\0');
  std::size_t used = 0;
  // A decompressor may deliver less at once than there is, and a member may be empty.
  for (bool goesOn = true; goesOn && used < most && members->problem().empty();)
  {
    const std::size_t written =
      members->step(std::as_writable_bytes(std::span(start)).subspan(used));
    used += written;
    goesOn = members->memberEnded() ? compressionOf(members->input()) == kind : written > 0;
    if (goesOn && members->memberEnded())
    {
      members->startMember(members->input());
    }
  }
  start.resize(used);
  return start;
}

} // namespace smg
