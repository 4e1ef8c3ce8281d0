// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/ByteOrder.h"
#include "IO/Files/InputFile.h"
#include "IO/Formats/Exodus/ExodusReader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string_view>

// Classic netCDF ("The NetCDF Classic Format Specification"): a list of dimensions, one of
// attributes and one of variables, then the numbers, big-endian. Variables of the record dimension
// have a part in each record.

namespace smg
{
namespace
{

/** The types of netCDF by their numbers from 1 on; texts have none. */
constexpr std::array<std::optional<ScalarType>, 12> NetCdfTypes{ std::nullopt, ScalarType::Int8,
  std::nullopt, ScalarType::Int16, ScalarType::Int32, ScalarType::Float32, ScalarType::Float64,
  ScalarType::UInt8, ScalarType::UInt16, ScalarType::UInt32, ScalarType::Int64,
  ScalarType::UInt64 };
constexpr std::int64_t TextType = 2;

class HeaderReader
{
public:
  explicit HeaderReader(InputFile& file)
    : File(file)
  {
  }

  NetCdfVariables read()
  {
    const std::string_view start = this->File.at(0, 4);
    this->Version = start.size() < 4 ? 0 : start[3];
    if (!start.starts_with("CDF") ||
        (this->Version != 1 && this->Version != 2 && this->Version != 5))
    {
      this->fail("a classic netCDF file begins with CDF and a version, 1, 2 or 5");
    }
    this->At = 4;
    this->Records = this->size();
    this->Records = this->Records == this->streaming() ? 0 : this->Records;
    const std::int64_t dimensions = this->listLength(10);
    for (std::int64_t i = 0; i < dimensions; ++i)
    {
      this->name();
      this->Dimensions.push_back(this->size());
    }
    this->skipAttributes(nullptr);
    const std::int64_t variables = this->listLength(11);
    for (std::int64_t i = 0; i < variables; ++i)
    {
      this->readVariable();
    }
    for (const std::string& name : this->RecordVariables)
    {
      this->Variables.byName.at(name).recordBytes = this->RecordBytes;
    }
    this->Variables.characters = [places = std::move(this->Places), &file = this->File](
                                   const std::string& name)
    {
      const auto found = places.find(name);
      return found == places.end() ? std::string() : charactersOf(file, found->second);
    };
    return std::move(this->Variables);
  }

private:
  struct Place
  {
    std::int64_t begin, bytes;
  };

  [[noreturn]] void fail(const std::string& sentence) const { this->File.fail(this->At, sentence); }

  std::int64_t streaming() const { return this->Version == 5 ? -1 : std::int64_t(UINT32_MAX); }

  template <class T>
  T take()
  {
    const std::string_view bytes = this->File.at(this->At, sizeof(T));
    if (bytes.size() < sizeof(T))
    {
      this->fail("the header of the file ends here: it is truncated");
    }
    const T value = numberAt<T>(bytes.data(), std::endian::big);
    this->At += sizeof(T);
    return value;
  }
  /** A count or an extent. */
  std::int64_t size()
  {
    return this->Version == 5 ? this->take<std::int64_t>()
                              : std::int64_t(this->take<std::uint32_t>());
  }

  /** A list with this tag; an absent one has none. */
  std::int64_t listLength(std::int32_t tag)
  {
    const auto found = this->take<std::int32_t>();
    const std::int64_t length = this->size();
    constexpr std::int64_t Most = 100000;
    if ((found != tag && (found != 0 || length != 0)) || length < 0 || length > Most)
    {
      this->fail(
        "a list of the header is damaged, or has more than " + std::to_string(Most) + " entries");
    }
    return length;
  }

  void skip(std::int64_t bytes)
  {
    if (bytes < 0 || bytes > static_cast<std::int64_t>(this->File.size()))
    {
      this->fail("a length in the header cannot be right");
    }
    this->At += static_cast<std::size_t>((bytes + 3) / 4 * 4);
  }

  std::string text(std::int64_t length)
  {
    constexpr std::int64_t Longest = 1024;
    if (length < 0 || length > Longest)
    {
      this->fail("a name in the header has " + std::to_string(length) + " bytes, but at most " +
                 std::to_string(Longest) + " are read");
    }
    const std::string_view bytes = this->File.at(this->At, static_cast<std::size_t>(length));
    std::string text(bytes.substr(0, static_cast<std::size_t>(length)));
    this->skip(length);
    return text;
  }
  std::string name() { return this->text(this->size()); }

  std::int64_t typeBytes(std::int64_t type) const
  {
    if (type < 1 || type >= std::ssize(NetCdfTypes))
    {
      this->fail("the type " + std::to_string(type) + " of numbers is not known");
    }
    const std::optional<ScalarType> scalar = NetCdfTypes[static_cast<std::size_t>(type)];
    return scalar ? static_cast<std::int64_t>(sizeOf(*scalar)) : 1;
  }

  /** Passes attributes; that of the type of elements is wanted. */
  void skipAttributes(std::string* elementType)
  {
    const std::int64_t attributes = this->listLength(12);
    for (std::int64_t i = 0; i < attributes; ++i)
    {
      const std::string name = this->name();
      const std::int64_t type = this->take<std::int32_t>(), values = this->size();
      if (elementType && name == "elem_type" && type == TextType)
      {
        *elementType = this->text(values);
        continue;
      }
      std::int64_t bytes = 0;
      this->skip(__builtin_mul_overflow(values, this->typeBytes(type), &bytes) ? -1 : bytes);
    }
  }

  void readVariable()
  {
    const std::string name = this->name();
    NetCdfVariable variable;
    const std::int64_t rank = this->size();
    constexpr std::int64_t MostDimensions = 8;
    if (rank < 0 || rank > MostDimensions)
    {
      this->fail("a variable has " + std::to_string(rank) + " dimensions");
    }
    std::int64_t values = 1;
    bool isOfRecords = false, overflows = false;
    for (std::int64_t k = 0; k < rank; ++k)
    {
      const std::int64_t dimension = this->size();
      if (dimension < 0 || dimension >= std::ssize(this->Dimensions))
      {
        this->fail("a variable has a dimension that the file does not have");
      }
      const std::int64_t extent = this->Dimensions[static_cast<std::size_t>(dimension)];
      isOfRecords = isOfRecords || (k == 0 && extent == 0);
      variable.extents.push_back(isOfRecords && k == 0 ? this->Records : extent);
      overflows =
        overflows || ((k > 0 || !isOfRecords) && __builtin_mul_overflow(values, extent, &values));
    }
    this->skipAttributes(&variable.elementType);
    const std::int64_t type = this->take<std::int32_t>();
    this->size(); // the bytes, which follow from the extents
    const std::int64_t begin =
      this->Version == 1 ? std::int64_t(this->take<std::int32_t>()) : this->take<std::int64_t>();
    std::int64_t bytes = 0;
    if (overflows || __builtin_mul_overflow(values, this->typeBytes(type), &bytes) || begin < 0 ||
        begin > static_cast<std::int64_t>(this->File.size()) ||
        (!isOfRecords && bytes > static_cast<std::int64_t>(this->File.size()) - begin))
    {
      this->fail("the variable '" + name + "' does not fit into the file: it is truncated");
    }
    this->Places[name] = { begin, bytes };
    if (isOfRecords)
    {
      this->RecordVariables.push_back(name);
      this->RecordBytes += (bytes + 3) / 4 * 4;
    }
    VtkArray& numbers = variable.numbers;
    numbers.name = name;
    numbers.begin = static_cast<std::size_t>(begin);
    numbers.values = NetCdfTypes[static_cast<std::size_t>(type)] ? values : 0;
    numbers.type = numbers.columnType =
      NetCdfTypes[static_cast<std::size_t>(type)].value_or(ScalarType::UInt8);
    numbers.encoding = VtkEncoding::Raw;
    numbers.byteOrder = std::endian::big;
    this->Variables.byName[name] = std::move(variable);
  }

  static std::string charactersOf(InputFile& file, const Place& place)
  {
    constexpr std::int64_t Most = std::int64_t(16) << 20;
    if (place.bytes > Most)
    {
      file.fail(static_cast<std::size_t>(place.begin), "a list of names is longer than 16 MiB");
    }
    const auto bytes = static_cast<std::size_t>(place.bytes);
    return std::string(file.at(static_cast<std::size_t>(place.begin), bytes).substr(0, bytes));
  }

  InputFile& File;
  std::size_t At = 0;
  int Version = 0;
  std::int64_t Records = 0, RecordBytes = 0;
  std::vector<std::int64_t> Dimensions;
  std::vector<std::string> RecordVariables;
  std::map<std::string, Place> Places;
  NetCdfVariables Variables;
};

} // namespace

VtkArray NetCdfVariable::range(std::int64_t first, std::int64_t count) const
{
  VtkArray range = this->numbers;
  range.begin += static_cast<std::size_t>(first) * (range.opener ? 1 : sizeOf(range.type));
  range.values = count;
  return range;
}

VtkArray NetCdfVariable::step(std::int64_t step, std::int64_t first, std::int64_t count) const
{
  if (this->recordBytes > 0)
  {
    VtkArray range = this->range(first, count);
    range.begin += static_cast<std::size_t>(step * this->recordBytes);
    return range;
  }
  std::int64_t size = 1;
  for (std::size_t k = 1; k < this->extents.size(); ++k)
  {
    size *= this->extents[k];
  }
  return this->range(step * size + first, count);
}

NetCdfVariables readNetCdfHeader(InputFile& file)
{
  return HeaderReader(file).read();
}

} // namespace smg
