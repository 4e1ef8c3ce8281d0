// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Ply/PlyRecords.h"

#include "IO/Formats/Ply/PlyHeader.h"
#include "IO/Formats/Vsm/AttributeNames.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace smg
{

namespace
{

bool isLongInteger(ScalarType type)
{
  return type == ScalarType::Int64 || type == ScalarType::UInt64;
}

/** The names of the properties of a column. */
std::vector<std::string> namesOf(const ColumnSpec& spec)
{
  if (isNormals(spec))
  {
    return { "nx", "ny", "nz" };
  }
  if (spec.name == ColorsName && spec.components == 3)
  {
    return { "red", "green", "blue" };
  }
  if (spec.name == ColorsName && spec.components == 4)
  {
    return { "red", "green", "blue", "alpha" };
  }
  std::string name = spec.name;
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return c <= ' ' || c >= 127; }, '_');
  if (spec.components == 1)
  {
    return { name };
  }
  std::vector<std::string> names;
  for (int k = 0; k < spec.components; ++k)
  {
    names.push_back(name + '_' + std::to_string(k));
  }
  return names;
}

/** Whether a double can represent a 64-bit integer. */
template <class T>
bool isExact(T value, double converted)
{
  // The largest integers are rounded to 2^63 and 2^64.
  constexpr double end = std::is_signed_v<T> ? 0x1p63 : 0x1p64;
  return converted < end && static_cast<T>(converted) == value;
}

} // namespace

std::string plyFormatLines()
{
  const bool little = std::endian::native == std::endian::little;
  return std::string("ply\nformat binary_") + (little ? "little" : "big") + "_endian 1.0\n";
}

PlyRecords::PlyRecords(const std::string& name, std::int64_t count)
  : Header("element " + name + ' ' + std::to_string(count) + '\n')
{
}

void PlyRecords::addPositions(bool isDouble)
{
  this->DoublePositions = isDouble;
  for (const char* name : { "x", "y", "z" })
  {
    this->add({ name, isDouble ? ScalarType::Float64 : ScalarType::Float32, 1 });
  }
}

void PlyRecords::add(const std::vector<ColumnSpec>& columns, WrittenPly& written)
{
  for (const ColumnSpec& column : columns)
  {
    this->Places.push_back(this->add(column));
    if (this->Places.back() < 0)
    {
      written.droppedColumns.push_back(column.name);
    }
  }
}

/** Returns the position of a column in the record, or -1 if a property already has its name. */
std::ptrdiff_t PlyRecords::add(const ColumnSpec& spec)
{
  const std::vector<std::string> names = namesOf(spec);
  for (const std::string& name : names)
  {
    if (name.empty() ||
        std::find(this->Names.begin(), this->Names.end(), name) != this->Names.end())
    {
      return -1;
    }
  }
  const ScalarType type = isLongInteger(spec.type) ? ScalarType::Float64 : spec.type;
  const auto place = static_cast<std::ptrdiff_t>(this->RecordBytes);
  for (const std::string& name : names)
  {
    this->add(std::string(plyTypeName(type)) + ' ' + name, sizeOf(type));
  }
  return place;
}

void PlyRecords::add(const std::string& property, std::size_t bytes)
{
  this->Header += "property " + property + '\n';
  this->Names.push_back(property.substr(property.rfind(' ') + 1));
  this->RecordBytes += bytes;
}

void PlyRecords::begin(std::size_t count)
{
  this->Records.resize(count * this->RecordBytes);
}

void PlyRecords::fill(std::ptrdiff_t place, std::span<const std::byte> tuples, std::size_t bytes)
{
  const std::byte* from = tuples.data();
  std::byte* const end = this->Records.data() + this->Records.size();
  for (std::byte* record = this->Records.data(); record < end; record += this->RecordBytes)
  {
    std::memcpy(record + place, from, bytes);
    from += bytes;
  }
}

void PlyRecords::fillPositions(std::span<const double> positions)
{
  if (this->DoublePositions)
  {
    this->fill(0, std::as_bytes(positions), 3 * sizeof(double));
    return;
  }
  this->Single.assign(positions.begin(), positions.end());
  this->fill(0, std::as_bytes(std::span(this->Single)), 3 * sizeof(float));
}

void PlyRecords::fill(const std::vector<Column>& columns, WrittenPly& written)
{
  std::vector<std::string>& rounded = written.roundedColumns;
  for (std::size_t i = 0; i < this->Places.size(); ++i)
  {
    const std::string& name = columns[i].spec.name;
    if (this->Places[i] >= 0 && this->fill(this->Places[i], columns[i]) &&
        std::find(rounded.begin(), rounded.end(), name) == rounded.end())
    {
      rounded.push_back(name);
    }
  }
}

/** Returns whether a value was rounded. */
bool PlyRecords::fill(std::ptrdiff_t place, const Column& column)
{
  if (!isLongInteger(column.spec.type))
  {
    this->fill(place, column.bytes, column.spec.tupleBytes());
    return false;
  }
  bool exact = true;
  const auto convert = [this, &exact]<class T>(std::span<const T> values)
  {
    this->Doubles.assign(values.begin(), values.end());
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      exact = exact && isExact(values[i], this->Doubles[i]);
    }
  };
  column.spec.type == ScalarType::Int64 ? convert(column.as<std::int64_t>())
                                        : convert(column.as<std::uint64_t>());
  this->fill(place, std::as_bytes(std::span(this->Doubles)),
    sizeof(double) * static_cast<std::size_t>(column.spec.components));
  return !exact;
}

} // namespace smg
