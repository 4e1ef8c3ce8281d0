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

/**
 * Restores a state that a StateWriter has written; see there. No count is believed before it is
 * compared with the bytes that are left; what cannot be is an Error that names the file.
 */
class SMG_EXPORT StateReader
{
public:
  /** The state is `bytes` bytes from `offset` on, which must not exceed the limit of the pool. Its
   * checksum is the caller's to check, with checksum(). */
  StateReader(FileDescriptor file, std::int64_t offset, std::int64_t bytes, Pool& pool);

  /** The checksum of all bytes, as of StateWriter. From then on, read() throws Error if it finds
   * others. */
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
  /** A number of items of at least so many bytes each. */
  std::size_t count(std::size_t itemBytes);

  FileDescriptor File;
  std::int64_t Begin, Next, End; // Next: the next byte to read
  Pool* Memory;
  std::vector<std::byte> Page;
  std::size_t PageUsed = 0;
  std::vector<std::uint64_t> Sums; // after each page
};

} // namespace smg
