// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/Inflate.h"

#include "Solver/Files/FileDescriptor.h"
#include "Solver/Memory/Buffer.h"
#include "smg/Error.h"

#include <algorithm>
#include <memory>
#include <span>

namespace smg
{

namespace
{

constexpr std::size_t SignBytes = 6; // for compressionOf()

/** Inflates a file from begin to end. */
class FileInflater
{
public:
  FileInflater(InputFile& file, Workspace& workspace, const std::filesystem::path& to)
    : File(file)
    , Space(workspace)
    , Chunk(workspace.pool(), std::size_t(256) << 10)
    , Out(FileDescriptor::createBeside(to))
    , Kind(compressionOf(file.at(0, SignBytes)))
    , Members(makeDecompressor(this->Kind))
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
      if (this->Members->memberEnded() && offset < this->File.size() && !this->startMember(offset))
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
        this->File.fail(end - this->Members->input().size(), std::string(this->Members->problem()));
      }
      this->Out.write(this->Written, this->Chunk.bytes().first(written));
      this->Written += static_cast<std::int64_t>(written);
      this->Space.traffic().bytesWritten += static_cast<std::int64_t>(written);
      // A small input can have a large output.
      this->Space.poll();
    } while (!this->Members->memberEnded() && written == this->Chunk.size());
  }

  /** Starts the member at `offset`; returns false if only padding follows. */
  bool startMember(std::size_t offset)
  {
    if (compressionOf(this->File.at(offset, SignBytes)) == this->Kind)
    {
      this->Members->startMember();
      return true;
    }
    for (std::size_t at = offset; at < this->File.size();)
    {
      const std::string_view bytes = this->File.at(at);
      if (bytes.find_first_not_of('\0') != std::string_view::npos)
      {
        this->File.fail(offset, "something comes after the compressed data");
      }
      at += bytes.size();
    }
    return false;
  }

  InputFile& File;
  Workspace& Space;
  Buffer Chunk;
  FileDescriptor Out;
  std::int64_t Written = 0;
  const Compression Kind;
  const std::unique_ptr<Decompressor> Members;
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
  const std::unique_ptr<Decompressor> members = makeDecompressor(compressionOf(bytes));
  members->setInput(bytes);
  std::string start(most, '\0');
  std::size_t used = 0;
  // A decompressor may deliver less at once than there is.
  for (std::size_t written = 1;
       written > 0 && !members->memberEnded() && members->problem().empty();)
  {
    written = members->step(std::as_writable_bytes(std::span(start)).subspan(used));
    used += written;
  }
  start.resize(used);
  return start;
}

} // namespace smg
