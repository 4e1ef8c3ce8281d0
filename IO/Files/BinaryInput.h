// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/ByteOrder.h"
#include "IO/Files/InputFile.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace smg
{

/**
 * Reads an InputFile as consecutive numbers in one byte order. Throws MeshErrors: where the file
 * ends, the place is the end of the last number.
 *
 * It reads from the window of the file: after other requests to the file, moveTo() must be called.
 */
class BinaryInput
{
public:
  BinaryInput(InputFile& file, std::size_t offset, std::endian order)
    : File(file)
    , Order(order)
  {
    this->moveTo(offset);
  }

  /** Of the following numbers. */
  void setByteOrder(std::endian order) { this->Order = order; }
  /** Continues at byte `offset` of the file. */
  void moveTo(std::size_t offset)
  {
    this->At = this->End = nullptr;
    this->EndOffset = std::min(offset, this->File.size());
  }

  /** The next number. The error at the end of the file says that it should be `what`. */
  template <class T>
  T take(const char* what = "a number")
  {
    if (static_cast<std::size_t>(this->End - this->At) < sizeof(T))
    {
      this->load(sizeof(T), what);
    }
    this->At += sizeof(T);
    return numberAt<T>(this->At - sizeof(T), this->Order);
  }

  void skip(std::size_t bytes)
  {
    if (bytes > static_cast<std::size_t>(this->End - this->At))
    {
      if (bytes > this->left())
      {
        this->failAtEnd("a number");
      }
      this->moveTo(this->offset() + bytes);
      return;
    }
    this->At += bytes;
  }

  /** Throws MeshError if a count, which is `what`, is more than the items of at least `minBytes`
   * bytes that the rest of the file can hold, or negative. */
  void requireRoom(std::int64_t count, std::size_t minBytes, const char* what) const
  {
    if (!fitsInFile(count, minBytes, this->left()))
    {
      throw MeshError(countError(count, what, this->left()));
    }
  }

  /** The offset in the file of the next byte. */
  std::size_t offset() const
  {
    return this->EndOffset - static_cast<std::size_t>(this->End - this->At);
  }
  /** Bytes from there to the end of the file. */
  std::size_t left() const { return this->File.size() - this->offset(); }

  /** Throws Error: "NAME, byte N: SENTENCE". */
  [[noreturn]] void fail(const std::string& sentence) const
  {
    this->File.fail(this->offset(), sentence);
  }
  /** Calls `read`; a MeshError gets its place. */
  template <class Read>
  void locateErrors(Read&& read) const
  {
    try
    {
      read();
    }
    catch (const MeshError& error)
    {
      this->fail(error.what());
    }
  }

private:
  [[noreturn]] static void failAtEnd(const char* what)
  {
    throw MeshError(std::string("the file ends where ") + what + " should be");
  }
  void load(std::size_t bytes, const char* what)
  {
    const std::size_t offset = this->offset();
    const std::string_view loaded = this->File.at(offset, bytes);
    this->At = loaded.data();
    this->End = loaded.data() + loaded.size();
    this->EndOffset = offset + loaded.size();
    if (loaded.size() < bytes)
    {
      failAtEnd(what);
    }
  }

  InputFile& File;
  std::endian Order;
  const char* At = nullptr;  ///< the next byte; up to End they are in memory
  const char* End = nullptr; ///< at EndOffset of the file
  std::size_t EndOffset = 0;
};

} // namespace smg
