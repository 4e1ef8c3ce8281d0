// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Exodus/NetCdfLayout.h"

#include "IO/Files/ByteOrder.h"

#include <algorithm>
#include <bit>
#include <span>

// "The NetCDF Classic Format Specification" (Unidata). Of files of 64-bit offsets counts have 32
// bits, of CDF-5 64 bits; numbers are big-endian, and everything is padded to four bytes.

namespace smg
{

/** Appends to the header. */
class NetCdfLayout::Packer
{
public:
  explicit Packer(bool isLarge)
    : IsLarge(isLarge)
  {
  }

  template <class T>
  void put(T value)
  {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(&value, 1));
    this->Bytes.insert(this->Bytes.end(), bytes.begin(), bytes.end());
    toByteOrder(std::endian::big, std::span(this->Bytes).last(sizeof(T)), sizeof(T));
  }
  void count(std::int64_t value)
  {
    this->IsLarge ? this->put(value) : this->put(static_cast<std::uint32_t>(value));
  }
  void list(std::int32_t tag, std::size_t length)
  {
    this->put(length == 0 ? 0 : tag);
    this->count(static_cast<std::int64_t>(length));
  }
  void bytes(std::span<const std::byte> bytes)
  {
    this->Bytes.insert(this->Bytes.end(), bytes.begin(), bytes.end());
    this->Bytes.resize((this->Bytes.size() + 3) / 4 * 4);
  }
  void name(const std::string& name)
  {
    this->count(std::ssize(name));
    this->bytes(std::as_bytes(std::span(name)));
  }
  void attributes(const std::vector<Attribute>& attributes)
  {
    this->list(12, attributes.size());
    for (const Attribute& attribute : attributes)
    {
      this->name(attribute.name);
      this->put(static_cast<std::int32_t>(attribute.type));
      this->count(attribute.count);
      this->bytes(attribute.bytes);
    }
  }

  std::vector<std::byte> Bytes;

private:
  bool IsLarge;
};

std::int64_t NetCdfLayout::bytesOf(Type type)
{
  return type == Type::Char ? 1 : type == Type::Int || type == Type::Float ? 4 : 8;
}

int NetCdfLayout::dimension(const std::string& name, std::int64_t size)
{
  this->IsLarge = this->IsLarge || size > INT32_MAX;
  this->Dimensions.push_back({ name, size });
  return static_cast<int>(this->Dimensions.size()) - 1;
}

int NetCdfLayout::records(const std::string& name, std::int64_t count)
{
  this->Records = count;
  return this->RecordDimension = this->dimension(name, 0);
}

NetCdfLayout::Attribute NetCdfLayout::textAttribute(
  const std::string& name, const std::string& text)
{
  const auto bytes = std::as_bytes(std::span(text));
  return { name, Type::Char, std::ssize(text), { bytes.begin(), bytes.end() } };
}

void NetCdfLayout::attribute(const std::string& name, const std::string& text)
{
  this->Attributes.push_back(textAttribute(name, text));
}

void NetCdfLayout::attribute(const std::string& name, std::int32_t value)
{
  Packer packer(false);
  packer.put(value);
  this->Attributes.push_back({ name, Type::Int, 1, std::move(packer.Bytes) });
}

void NetCdfLayout::attribute(const std::string& name, float value)
{
  Packer packer(false);
  packer.put(std::bit_cast<std::uint32_t>(value));
  this->Attributes.push_back({ name, Type::Float, 1, std::move(packer.Bytes) });
}

int NetCdfLayout::variable(
  const std::string& name, Type type, const std::vector<int>& dimensions, const Texts& attributes)
{
  Variable& added = this->Variables.emplace_back();
  added.name = name;
  added.type = type;
  added.dimensions = dimensions;
  added.isOfRecords = !dimensions.empty() && dimensions[0] == this->RecordDimension;
  added.bytes = bytesOf(type);
  for (std::size_t k = added.isOfRecords ? 1 : 0; k < dimensions.size(); ++k)
  {
    added.bytes *= this->Dimensions[std::size_t(dimensions[k])].size;
  }
  this->IsLarge = this->IsLarge || added.bytes > INT32_MAX;
  for (const auto& [key, text] : attributes)
  {
    added.attributes.push_back(textAttribute(key, text));
  }
  return static_cast<int>(this->Variables.size()) - 1;
}

void NetCdfLayout::place()
{
  std::int64_t end = std::ssize(this->header());
  for (const bool areOfRecords : { false, true })
  {
    for (Variable& variable : this->Variables)
    {
      if (variable.isOfRecords == areOfRecords)
      {
        variable.begin = end;
        end += (areOfRecords && this->Records == 0 ? 0 : variable.bytes + 3) / 4 * 4;
      }
    }
  }
}

std::vector<std::byte> NetCdfLayout::header() const
{
  Packer packer(this->IsLarge);
  constexpr char Magic[] = { 'C', 'D', 'F' };
  packer.Bytes.assign({ std::byte(Magic[0]), std::byte(Magic[1]), std::byte(Magic[2]),
    std::byte(this->IsLarge ? 5 : 2) });
  packer.count(this->Records);
  packer.list(10, this->Dimensions.size());
  for (const Dimension& dimension : this->Dimensions)
  {
    packer.name(dimension.name);
    packer.count(dimension.size);
  }
  packer.attributes(this->Attributes);
  packer.list(11, this->Variables.size());
  for (const Variable& variable : this->Variables)
  {
    packer.name(variable.name);
    packer.count(std::ssize(variable.dimensions));
    for (const int dimension : variable.dimensions)
    {
      packer.count(dimension);
    }
    packer.attributes(variable.attributes);
    packer.put(static_cast<std::int32_t>(variable.type));
    packer.count((variable.bytes + 3) / 4 * 4);
    packer.put(variable.begin);
  }
  return std::move(packer.Bytes);
}

} // namespace smg
