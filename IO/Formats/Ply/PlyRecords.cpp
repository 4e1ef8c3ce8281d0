// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Ply/PlyRecords.h"

#include "IO/Formats/Ply/PlyHeader.h"
#include "IO/Mesh/AttributeNames.h"

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

/** A name of visible ASCII characters. */
std::string plyName(std::string name)
{
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return c <= ' ' || c >= 127; }, '_');
  return name;
}

/** The names of the properties of a column that has this name in the file. */
std::vector<std::string> namesOf(const ColumnSpec& spec, const std::string& name)
{
  if (isNormals(spec) && name == spec.name)
  {
    return { "nx", "ny", "nz" };
  }
  if (spec.name == ColorsName && name == spec.name && spec.components == 3)
  {
    return { "red", "green", "blue" };
  }
  if (spec.name == ColorsName && name == spec.name && spec.components == 4)
  {
    return { "red", "green", "blue", "alpha" };
  }
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
    const ScalarType type = isDouble ? ScalarType::Float64 : ScalarType::Float32;
    this->add(std::string(plyTypeName(type)) + ' ' + name, sizeOf(type));
  }
}

void PlyRecords::add(const std::vector<ColumnSpec>& columns, WrittenPly& written)
{
  // Columns that can keep their names do so, whatever others would be called.
  std::vector<std::vector<std::string>> names(columns.size());
  const auto choose = [&](std::size_t i, const std::string& name)
  {
    const std::vector<std::string> chosen = namesOf(columns[i], name);
    if (!this->areFree(chosen))
    {
      return false;
    }
    this->Names.insert(this->Names.end(), chosen.begin(), chosen.end());
    names[i] = chosen;
    return true;
  };
  for (const bool severalProperties : { false, true })
  {
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      const std::string& name = columns[i].name;
      if ((columns[i].components > 1) == severalProperties && plyName(name) == name)
      {
        choose(i, name);
      }
    }
  }
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const std::string base = plyName(columns[i].name);
    std::string name = base;
    for (int k = 1; names[i].empty() && !choose(i, name); ++k)
    {
      name = base + '_' + std::to_string(k);
    }
    if (name != columns[i].name)
    {
      written.renamedColumns.emplace_back(columns[i].name, name);
    }
    const ScalarType type = isLongInteger(columns[i].type) ? ScalarType::Float64 : columns[i].type;
    this->Places.push_back(static_cast<std::ptrdiff_t>(this->RecordBytes));
    for (const std::string& property : names[i])
    {
      this->addProperty(std::string(plyTypeName(type)) + ' ' + property, sizeOf(type));
    }
  }
}

/** Whether no property has one of these names. */
bool PlyRecords::areFree(const std::vector<std::string>& names) const
{
  return std::ranges::none_of(names, [this](const std::string& name)
    { return std::ranges::find(this->Names, name) != this->Names.end(); });
}

void PlyRecords::addProperty(const std::string& property, std::size_t bytes)
{
  this->Header += "property " + property + '\n';
  this->RecordBytes += bytes;
}

void PlyRecords::add(const std::string& property, std::size_t bytes)
{
  this->Names.push_back(property.substr(property.rfind(' ') + 1));
  this->addProperty(property, bytes);
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
    if (this->fill(this->Places[i], columns[i]) &&
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
