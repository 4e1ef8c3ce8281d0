// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace smg
{

/** The scalar types of columns. The values are part of the `.vsm` format. */
enum class ScalarType : std::uint8_t
{
  Int8 = 0,    ///< signed, 1 byte
  UInt8 = 1,   ///< unsigned, 1 byte
  Int16 = 2,   ///< signed, 2 bytes
  UInt16 = 3,  ///< unsigned, 2 bytes
  Int32 = 4,   ///< signed, 4 bytes
  UInt32 = 5,  ///< unsigned, 4 bytes
  Int64 = 6,   ///< signed, 8 bytes
  UInt64 = 7,  ///< unsigned, 8 bytes
  Float32 = 8, ///< single precision
  Float64 = 9  ///< double precision
};

/** Bytes of one scalar: 1, 2, 4 or 8. */
constexpr std::size_t sizeOf(ScalarType type)
{
  constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 8, 8, 4, 8 };
  return sizes[static_cast<int>(type)];
}

/** The name of a scalar type, from "int8" to "float64". */
constexpr std::string_view nameOf(ScalarType type)
{
  constexpr std::string_view names[] = { "int8", "uint8", "int16", "uint16", "int32", "uint32",
    "int64", "uint64", "float32", "float64" };
  return names[static_cast<int>(type)];
}

/** The ScalarType of the C++ arithmetic type T, of at most 8 bytes. */
template <class T>
constexpr ScalarType scalarTypeOf()
{
  static_assert(std::is_arithmetic_v<T> && sizeof(T) <= 8);
  if constexpr (std::is_floating_point_v<T>)
  {
    return sizeof(T) == 4 ? ScalarType::Float32 : ScalarType::Float64;
  }
  else
  {
    constexpr int log2 = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3;
    return static_cast<ScalarType>(2 * log2 + (std::is_unsigned_v<T> ? 1 : 0));
  }
}

/** Calls `f` with a 0 of the C++ type that corresponds to `type`; returns what `f` returns. */
template <class F>
decltype(auto) dispatch(ScalarType type, F&& f)
{
  switch (type)
  {
    case ScalarType::Int8:
      return f(std::int8_t{});
    case ScalarType::UInt8:
      return f(std::uint8_t{});
    case ScalarType::Int16:
      return f(std::int16_t{});
    case ScalarType::UInt16:
      return f(std::uint16_t{});
    case ScalarType::Int32:
      return f(std::int32_t{});
    case ScalarType::UInt32:
      return f(std::uint32_t{});
    case ScalarType::Int64:
      return f(std::int64_t{});
    case ScalarType::UInt64:
      return f(std::uint64_t{});
    case ScalarType::Float32:
      return f(float{});
    default:
      return f(double{});
  }
}

/** Compression of the columns of a `.vsm` file. The values are part of the format. */
enum class Codec : std::uint8_t
{
  None = 0, ///< not compressed
  Lz4 = 1,  ///< LZ4: fast
  Zstd = 2  ///< Zstandard: small
};

/** Name and type of a column. */
struct ColumnSpec
{
  std::string name;                      ///< name of the column
  ScalarType type = ScalarType::Float64; ///< of each component
  int components = 1;                    ///< scalars in a tuple, at least 1
  /** Each component at the vertices of no cell, which no stream contains; none: what the mesh has
   * there, else 0. */
  std::optional<double> isolated = {};

  /** Bytes of a tuple. */
  std::size_t tupleBytes() const { return sizeOf(this->type) * this->components; }
  /** Whether name, type and number of components are equal. */
  bool operator==(const ColumnSpec& other) const
  {
    return this->name == other.name && this->type == other.type &&
           this->components == other.components;
  }
};

/** An attribute of vertices or cells: a tuple for each of them. */
struct Column
{
  ColumnSpec spec;              ///< name and type
  std::vector<std::byte> bytes; ///< the tuples, one after the other, in native byte order

  /** Number of tuples. */
  std::size_t tuples() const { return this->bytes.size() / this->spec.tupleBytes(); }
  /** Changes the number of tuples; new ones are zero. */
  void resize(std::size_t tuples) { this->bytes.resize(tuples * this->spec.tupleBytes()); }

  /** All components of all tuples as T, which must be the column's own type (asserted). */
  template <class T>
  std::span<T> as()
  {
    assert(scalarTypeOf<T>() == this->spec.type);
    return { reinterpret_cast<T*>(this->bytes.data()), this->bytes.size() / sizeof(T) };
  }
  /** The same, read-only. */
  template <class T>
  std::span<const T> as() const
  {
    assert(scalarTypeOf<T>() == this->spec.type);
    return { reinterpret_cast<const T*>(this->bytes.data()), this->bytes.size() / sizeof(T) };
  }

  /** Component `component` of tuple `tuple`, both counted from 0, converted to double. Neither
   * number is checked. */
  double value(std::size_t tuple, int component = 0) const
  {
    const std::byte* p =
      this->bytes.data() + tuple * this->spec.tupleBytes() + component * sizeOf(this->spec.type);
    return dispatch(this->spec.type,
      [p]<class T>(T) { return static_cast<double>(*reinterpret_cast<const T*>(p)); });
  }
};

/** Index of the first column that equals `spec`; -1 if there is none. */
inline std::ptrdiff_t findColumn(const std::vector<ColumnSpec>& specs, const ColumnSpec& spec)
{
  const auto found = std::ranges::find(specs, spec);
  return found == specs.end() ? -1 : found - specs.begin();
}
/** The same among columns with their values. */
inline std::ptrdiff_t findColumn(const std::vector<Column>& columns, const ColumnSpec& spec)
{
  const auto found = std::ranges::find(columns, spec, &Column::spec);
  return found == columns.end() ? -1 : found - columns.begin();
}

} // namespace smg
