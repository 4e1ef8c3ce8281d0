// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace smg
{

/** The scalar types a column may have. The values are part of the file format. */
enum class ScalarType : std::uint8_t
{
  Int8 = 0,
  UInt8 = 1,
  Int16 = 2,
  UInt16 = 3,
  Int32 = 4,
  UInt32 = 5,
  Int64 = 6,
  UInt64 = 7,
  Float32 = 8,
  Float64 = 9
};

/** Bytes of one scalar. */
constexpr std::size_t sizeOf(ScalarType type)
{
  constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 8, 8, 4, 8 };
  return sizes[static_cast<int>(type)];
}

/** "int8" ... "float64". */
constexpr std::string_view nameOf(ScalarType type)
{
  constexpr std::string_view names[] = { "int8", "uint8", "int16", "uint16", "int32", "uint32",
    "int64", "uint64", "float32", "float64" };
  return names[static_cast<int>(type)];
}

/** The ScalarType of a C++ arithmetic type. */
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

/** Calls f with a value-initialised scalar of the C++ type that `type` names. */
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

/** How the values of columns are compressed in a file. The values are part of the file format. */
enum class Codec : std::uint8_t
{
  None = 0,
  Lz4 = 1,
  Zstd = 2
};

/** What a column is: its name, scalar type and number of components of a tuple. */
struct ColumnSpec
{
  std::string name;
  ScalarType type = ScalarType::Float64;
  int components = 1;

  std::size_t tupleBytes() const { return sizeOf(this->type) * this->components; }
  bool operator==(const ColumnSpec&) const = default;
};

/** A column of values, tuples one after the other: an attribute of vertices or of cells. */
struct Column
{
  ColumnSpec spec;
  std::vector<std::byte> bytes;

  std::size_t tuples() const { return this->bytes.size() / this->spec.tupleBytes(); }
  void resize(std::size_t tuples) { this->bytes.resize(tuples * this->spec.tupleBytes()); }

  /** The values as T, which must be the type of the column. */
  template <class T>
  std::span<T> as()
  {
    assert(scalarTypeOf<T>() == this->spec.type);
    return { reinterpret_cast<T*>(this->bytes.data()), this->bytes.size() / sizeof(T) };
  }
  template <class T>
  std::span<const T> as() const
  {
    assert(scalarTypeOf<T>() == this->spec.type);
    return { reinterpret_cast<const T*>(this->bytes.data()), this->bytes.size() / sizeof(T) };
  }

  /** Component `component` of tuple `tuple`, converted to double. */
  double value(std::size_t tuple, int component = 0) const
  {
    const std::byte* p =
      this->bytes.data() + tuple * this->spec.tupleBytes() + component * sizeOf(this->spec.type);
    return dispatch(this->spec.type,
      [p]<class T>(T) { return static_cast<double>(*reinterpret_cast<const T*>(p)); });
  }
};

/** The index of the first column equal to `spec`; -1 if there is none. */
inline std::ptrdiff_t findColumn(const std::vector<ColumnSpec>& specs, const ColumnSpec& spec)
{
  const auto found = std::ranges::find(specs, spec);
  return found == specs.end() ? -1 : found - specs.begin();
}
inline std::ptrdiff_t findColumn(const std::vector<Column>& columns, const ColumnSpec& spec)
{
  const auto found = std::ranges::find(columns, spec, &Column::spec);
  return found == columns.end() ? -1 : found - columns.begin();
}

} // namespace smg
