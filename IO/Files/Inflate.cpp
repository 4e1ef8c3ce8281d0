// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/Inflate.h"

#include "Solver/Files/FileDescriptor.h"
#include "Solver/Memory/Buffer.h"
#include "smg/Error.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <span>
#include <system_error>

namespace smg
{

namespace
{

/** Inflates members of a gzip file. */
class GzipStream
{
public:
  GzipStream()
  {
    constexpr int onlyGzip = 16;
    if (inflateInit2(&this->Stream, MAX_WBITS + onlyGzip) != Z_OK)
    {
      throw std::bad_alloc();
    }
  }
  ~GzipStream() { inflateEnd(&this->Stream); }
  GzipStream(const GzipStream&) = delete;
  GzipStream& operator=(const GzipStream&) = delete;

  /** Sets the input of the next calls of step(). */
  void setInput(std::string_view bytes)
  {
    constexpr std::size_t most = std::numeric_limits<uInt>::max();
    // zlib does not write to its input, in spite of its type.
    this->Stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    this->Stream.avail_in = static_cast<uInt>(std::min(bytes.size(), most));
  }
  std::string_view input() const
  {
    return { reinterpret_cast<const char*>(this->Stream.next_in), this->Stream.avail_in };
  }

  /** Inflates the available input as far as there is room; returns the bytes written. */
  std::size_t step(std::span<std::byte> room)
  {
    this->Stream.next_out = reinterpret_cast<Bytef*>(room.data());
    this->Stream.avail_out = static_cast<uInt>(room.size());
    const int result = inflate(&this->Stream, Z_NO_FLUSH);
    if (result == Z_MEM_ERROR)
    {
      throw std::bad_alloc();
    }
    this->MemberEnded = result == Z_STREAM_END;
    // A buffer error of zlib only means that no further progress is possible.
    this->Damaged = !this->MemberEnded && result != Z_OK && result != Z_BUF_ERROR;
    return room.size() - this->Stream.avail_out;
  }
  bool memberEnded() const { return this->MemberEnded; }
  bool damaged() const { return this->Damaged; }

  void startMember()
  {
    inflateReset(&this->Stream);
    this->MemberEnded = false;
  }

private:
  z_stream Stream{};
  bool MemberEnded = false;
  bool Damaged = false;
};

/** Inflates a file from begin to end. */
class FileInflater
{
public:
  FileInflater(InputFile& file, Workspace& workspace, const std::filesystem::path& to)
    : File(file)
    , Space(workspace)
    , Chunk(workspace.pool(), std::size_t(256) << 10)
    , Out(FileDescriptor::createBeside(to))
  {
  }
  FileInflater(const FileInflater&) = delete;
  FileInflater& operator=(const FileInflater&) = delete;

  void run()
  {
    for (std::size_t offset = 0; offset < this->File.size();)
    {
      this->Gzip.setInput(this->File.at(offset));
      const std::size_t bytes = this->Gzip.input().size();
      this->inflateInput(offset + bytes);
      offset += bytes - this->Gzip.input().size();
      if (this->Gzip.memberEnded() && offset < this->File.size() && !this->startMember(offset))
      {
        break;
      }
    }
    if (!this->Gzip.memberEnded())
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
      written = this->Gzip.step(this->Chunk.bytes());
      if (this->Gzip.damaged())
      {
        this->File.fail(end - this->Gzip.input().size(), "the compressed data are damaged");
      }
      this->Out.write(this->Written, this->Chunk.bytes().first(written));
      this->Written += static_cast<std::int64_t>(written);
      this->Space.traffic().bytesWritten += static_cast<std::int64_t>(written);
      // A small input can have a large output.
      this->Space.poll();
    } while (!this->Gzip.memberEnded() && written == this->Chunk.size());
  }

  /** Starts the member at `offset`; returns false if only padding follows. */
  bool startMember(std::size_t offset)
  {
    if (isGzip(this->File.at(offset, 2)))
    {
      this->Gzip.startMember();
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
  GzipStream Gzip;
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
  GzipStream gzip;
  gzip.setInput(bytes);
  std::string start(most, '\0');
  start.resize(gzip.step(std::as_writable_bytes(std::span(start))));
  return start;
}

} // namespace smg
