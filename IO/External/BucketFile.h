// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "Solver/Files/CheckedFile.h"
#include "Solver/Files/State.h"
#include "Solver/Memory/Buffer.h"
#include "smg/Export.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace smg
{

/**
 * Sequences of bytes in one unnamed scratch file. Bytes are appended to any of a number of buckets;
 * each bucket is read from first to last, any number of times. Only the last chunk of a bucket is
 * in memory; no file is created until a chunk is full.
 *
 * With several threads, the owner of the threads of the workspace waits neither for the disk nor
 * for checksums: while it fills a chunk, the one before is written on another thread, and readers
 * fetch what comes next. A part of the same memory serves for that.
 */
class SMG_EXPORT BucketFile
{
public:
  static constexpr std::size_t ChunkBytes = std::size_t(256) << 10;
  /** The minimum size of a chunk. */
  static constexpr std::size_t MinChunkBytes = std::size_t(4) << 10;
  /** A reader of fewer bytes fetches nothing ahead. */
  static constexpr std::size_t MinAheadBytes = std::size_t(128) << 10;

  /** The workspace must outlive the file. The chunks use at most `memory` bytes. */
  explicit BucketFile(
    Workspace& workspace, int buckets = 1, std::int64_t memory = std::int64_t(ChunkBytes));
  ~BucketFile();
  BucketFile(BucketFile&&) noexcept;
  BucketFile& operator=(BucketFile&&) noexcept;

  int buckets() const { return static_cast<int>(this->Rows.size()); }
  std::int64_t bytes(int bucket = 0) const { return this->Rows[std::size_t(bucket)].bytes; }

  /** Appends to a bucket. Throws Error, naming the folder, if the disk is full. */
  void append(int bucket, std::span<const std::byte> bytes)
  {
    Row& row = this->Rows[std::size_t(bucket)];
    if (row.used + bytes.size() <= this->Chunk && row.chunk.data())
    {
      std::copy_n(bytes.data(), bytes.size(), row.chunk.data() + row.used);
      row.used += bytes.size();
      row.bytes += static_cast<std::int64_t>(bytes.size());
    }
    else
    {
      this->appendSlowly(row, bytes);
    }
  }
  template <class T>
  void put(int bucket, const T& value)
  {
    this->append(bucket, std::as_bytes(std::span<const T, 1>(&value, 1)));
  }

  /** Writes the last chunks to the file and releases their memory; nothing may be appended
   * afterwards. */
  void close();

  /** Closes the file, gives it a name in the same file system, waits until the disk has it, and
   * saves what load() needs. Later calls only save that. */
  void save(StateWriter& state, const std::filesystem::path& path);
  /** Restores a file, which must be empty and have as many buckets; compares its content with the
   * checksums. */
  void load(StateReader& state, const std::filesystem::path& path);

private:
  /** Of the next byte to read. */
  struct Position
  {
    int bucket;
    std::int64_t offset = 0; ///< in the bucket
    std::size_t run = 0;
    std::int64_t runOffset = 0;
  };

public:
  /** Reads a bucket sequentially. The file must outlive the reader and not be appended to. */
  class Reader
  {
  public:
    explicit Reader(const BucketFile& file, int bucket = 0, std::size_t bufferBytes = ChunkBytes);
    ~Reader();
    Reader(Reader&&) noexcept;
    Reader& operator=(Reader&&) noexcept;

    /** The next bytes, at most `most`, a multiple of `unit`, like the size of the bucket; empty at
     * the end. */
    std::span<const std::byte> next(std::size_t unit, std::size_t most = SIZE_MAX);
    /** Reads exactly this number of bytes; returns false at the end. */
    bool read(std::span<std::byte> bytes);
    template <class T>
    bool get(T& value)
    {
      if (this->End - this->At >= sizeof(T))
      {
        std::memcpy(&value, this->Bytes.data() + this->At, sizeof(T));
        this->At += sizeof(T);
        return true;
      }
      return this->read(std::as_writable_bytes(std::span<T, 1>(&value, 1)));
    }

  private:
    class Ahead;

    bool refill();
    void stopAhead();

    const BucketFile* File;
    Position From;
    Buffer Bytes;
    std::size_t At = 0, End = 0;
    std::size_t AheadBytes = 0;     ///< that are fetched ahead from the first refill() on
    std::unique_ptr<Ahead> Fetched; ///< none: nothing is fetched ahead
  };

private:
  /** Bytes that are contiguous in the file. */
  struct Run
  {
    std::int64_t offset;
    std::int64_t bytes;
  };
  struct Row
  {
    Buffer chunk;
    std::size_t used = 0;
    std::int64_t bytes = 0; ///< including those in the chunk
    std::vector<Run> runs;
  };

  class Output;

  void appendSlowly(Row& row, std::span<const std::byte> bytes);
  void flush(Row& row);
  /** Fills `bytes` from a position, except perhaps for a part of a grain at the end, and moves the
   * position. Returns the number of bytes; 0 at the end. On any thread. */
  std::size_t fill(Position& from, std::span<std::byte> bytes) const;

  Workspace* Space;
  std::size_t Chunk;
  std::vector<Row> Rows;
  std::int64_t End = 0; ///< of the file, with the chunk that is being written
  std::unique_ptr<Output> Out;
};

/** A file of one sequence of records. */
template <class Record>
class RecordFile
{
  static_assert(std::is_trivially_copyable_v<Record>);

public:
  explicit RecordFile(Workspace& workspace)
    : File(workspace)
  {
  }

  std::int64_t size() const { return this->File.bytes() / std::int64_t(sizeof(Record)); }
  void put(const Record& record) { this->File.put(0, record); }
  void put(std::span<const Record> records) { this->File.append(0, std::as_bytes(records)); }
  void close() { this->File.close(); }
  BucketFile& bytes() { return this->File; }

  /** Reads the records from first to last. */
  class Reader
  {
  public:
    explicit Reader(const RecordFile& file)
      : Bytes(file.File)
    {
    }
    /** Reads the next record; returns false at the end. */
    bool next(Record& record) { return this->Bytes.get(record); }
    /** Fills the span; returns false at the end, without reading anything. */
    bool next(std::span<Record> records)
    {
      return this->Bytes.read(std::as_writable_bytes(records));
    }

  private:
    BucketFile::Reader Bytes;
  };

private:
  BucketFile File;
};

} // namespace smg
