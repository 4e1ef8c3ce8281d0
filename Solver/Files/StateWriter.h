// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FileDescriptor.h"
#include "smg/Export.h"

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

  /** Begins a part with a name, by which the reader finds out if it reads something else. */
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
  std::int64_t Begin, End; // End: of what is written
  std::uint64_t Checksum = 0;
  std::vector<std::byte> Page;
};

/** The bytes of a state are checked page by page: the checksum after a page is that of the page and
 * of the checksum before. */
struct SMG_EXPORT StatePages
{
  static constexpr std::size_t Bytes = std::size_t(64) << 10;
  static std::uint64_t add(std::uint64_t checksum, std::span<const std::byte> page);
};

} // namespace smg
