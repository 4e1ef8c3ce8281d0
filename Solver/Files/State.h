// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FileDescriptor.h"
#include "Solver/Memory/Pool.h"
#include "smg/Export.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace smg
{

/** Restores a state that a StateWriter has written; see there. A count is compared with the bytes
 * that are left before it is believed; what cannot be is an Error that names the file. */
class SMG_EXPORT StateReader
{
public:
  /** The state is the `bytes` bytes of the file from `offset` on; more than the limit of the pool
   * are an Error. The caller compares checksum() with the one that it knows. */
  StateReader(FileDescriptor file, std::int64_t offset, std::int64_t bytes, Pool& pool);

  /** The checksum of all bytes, computed like StateWriter::checksum(). From then on, read() throws
   * Error if the file returns other bytes. */
  std::uint64_t checksum();

  template <class... Values>
  void operator()(Values&... values)
  {
    (this->get(values), ...);
  }

  /** Begins the part with this name. */
  void part(std::string_view name);
  /** Reads bytes. */
  void read(std::span<std::byte> bytes);
  /** To be called after the last part. */
  void finish() const { this->require(this->left() == 0); }

  /** Throws the Error of a damaged state unless `valid`. */
  void require(bool valid) const
  {
    if (!valid)
    {
      this->fail("it contradicts itself");
    }
  }
  /** Throws the Error of a damaged state. */
  [[noreturn]] void fail(const std::string& reason) const;

  /** The memory of the computation. */
  Pool& pool() const { return *this->Memory; }

private:
  std::int64_t left() const { return this->End - this->Next; }

  template <class T>
  void get(T& value)
  {
    if constexpr (requires { value.load(*this); })
    {
      value.load(*this);
    }
    else if constexpr (requires { value.exchange(*this); })
    {
      value.exchange(*this);
    }
    else
    {
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
      std::array<std::byte, sizeof(T)> bytes;
      this->read(bytes);
      value = std::bit_cast<T>(bytes);
    }
  }
  void get(bool& value)
  {
    std::uint8_t byte = 0;
    this->get(byte);
    this->require(byte <= 1);
    value = byte == 1;
  }
  void get(std::string& text)
  {
    text.resize(this->count(1));
    this->read(std::as_writable_bytes(std::span(text)));
  }
  template <class T>
  void get(std::vector<T>& values)
  {
    if constexpr (std::is_trivially_copyable_v<T> &&
                  !requires(T value, StateReader & state) { value.exchange(state); })
    {
      values.resize(this->count(sizeof(T)));
      this->read(std::as_writable_bytes(std::span(values)));
    }
    else
    {
      values.clear();
      for (std::size_t left = this->count(1); left > 0; --left)
      {
        this->get(values.emplace_back());
      }
    }
  }
  template <class T>
  void get(std::optional<T>& value)
  {
    bool given = false;
    this->get(given);
    if (!given)
    {
      value.reset();
    }
    else if constexpr (std::is_default_constructible_v<T>)
    {
      this->get(value.emplace());
    }
    else
    {
      std::array<std::byte, sizeof(T)> bytes;
      this->read(bytes);
      value = std::bit_cast<T>(bytes);
    }
  }
  void checkPage() const;
  /** Reads a number of items, each of which takes at least `itemBytes` bytes. */
  std::size_t count(std::size_t itemBytes);

  FileDescriptor File;
  std::int64_t Begin, Next, End; // offsets in the file; Next: of the next byte to read
  Pool* Memory;
  std::vector<std::byte> Page;
  std::size_t PageUsed = 0;
  std::vector<std::uint64_t> Sums; // after each page
};

/**
 * Writes the state of a computation to a file, from which a StateReader restores it. The members of
 * a class are listed once, for both directions:
 *
 *     template <class State> void exchange(State& state) { state(this->Count, this->Names); }
 *
 * A class whose directions differ has save(StateWriter&) and load(StateReader&) instead. Other
 * values are numbers, trivially copyable structures, strings, and vectors and optional values of
 * all these. Only a few pages are in memory.
 */
class SMG_EXPORT StateWriter
{
public:
  /** The state begins at `offset` of the file, which must outlive this object. */
  StateWriter(const FileDescriptor& file, std::int64_t offset)
    : File(file)
    , Begin(offset)
    , End(offset)
  {
  }

  template <class... Values>
  void operator()(Values&... values)
  {
    (this->put(values), ...);
  }

  /** Begins a part with a name, by which the reader notices that it reads something else. */
  void part(std::string_view name) { this->put(std::string(name)); }

  /** Appends bytes. */
  void write(std::span<const std::byte> bytes);

  /** Writes the rest. */
  void finish();
  /** After finish(): bytes of the state. */
  std::int64_t bytes() const { return this->End - this->Begin; }
  /** After finish(): the checksum of the state, see StatePages. */
  std::uint64_t checksum() const { return this->Checksum; }

private:
  template <class T>
  void put(T& value)
  {
    if constexpr (requires { value.save(*this); })
    {
      value.save(*this);
    }
    else if constexpr (requires { value.exchange(*this); })
    {
      value.exchange(*this);
    }
    else
    {
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
      this->write(std::as_bytes(std::span(&value, 1)));
    }
  }
  void put(std::string& text) { this->putItems(text); }
  void put(const std::string& text) { this->putItems(text); }
  template <class T>
  void put(std::vector<T>& values)
  {
    if constexpr (std::is_trivially_copyable_v<T> &&
                  !requires(T value, StateWriter & state) { value.exchange(state); })
    {
      this->putItems(values);
    }
    else
    {
      auto count = static_cast<std::uint64_t>(values.size());
      this->put(count);
      for (T& value : values)
      {
        this->put(value);
      }
    }
  }
  template <class T>
  void put(std::optional<T>& value)
  {
    const std::uint8_t given = value ? 1 : 0;
    this->put(given);
    if (value)
    {
      this->put(*value);
    }
  }
  template <class Items>
  void putItems(const Items& items)
  {
    const auto count = static_cast<std::uint64_t>(items.size());
    this->put(count);
    this->write(std::as_bytes(std::span(items)));
  }

  const FileDescriptor& File;
  std::int64_t Begin, End; // offsets in the file; End: behind what is written
  std::uint64_t Checksum = 0;
  std::vector<std::byte> Page;
};

/** The chained checksum of a state: that after a page covers the page and the checksum before
 * it. */
struct SMG_EXPORT StatePages
{
  static constexpr std::size_t Bytes = std::size_t(64) << 10;
  static std::uint64_t add(std::uint64_t checksum, std::span<const std::byte> page);
};

} // namespace smg
