// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkXmlArray.h"

#include "IO/Files/InQuotes.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <string_view>

namespace smg
{

namespace
{

/** No file has more points, cells or bytes. */
constexpr std::int64_t MostThings = std::int64_t(1) << 48;

} // namespace

VtkXmlEncoding vtkXmlEncoding(const InputFile& file, const XmlTag& root)
{
  VtkXmlEncoding encoding;
  encoding.byteOrder =
    root.value("byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
  encoding.headerBytes = root.value("header_type", "UInt32") == "UInt64" ? 8 : 4;
  const std::string compressor = root.value("compressor");
  encoding.compression = compressor.empty()                      ? VtkCompression::None
                         : compressor == "vtkZLibDataCompressor" ? VtkCompression::Zlib
                         : compressor == "vtkLZ4DataCompressor"  ? VtkCompression::Lz4
                                                                 : VtkCompression::Lzma;
  if (encoding.compression == VtkCompression::Lzma && compressor != "vtkLZMADataCompressor")
  {
    file.fail(root.begin, "the compressor " + inQuotes(compressor) + " is not known");
  }
  return encoding;
}

VtkArray vtkXmlArray(
  const InputFile& file, const XmlTag& tag, ScalarType type, const VtkXmlEncoding& encoding)
{
  VtkArray array;
  array.name = tag.value("Name");
  array.type = array.columnType = type;
  array.begin = tag.end;
  array.byteOrder = encoding.byteOrder;
  const std::int64_t components =
    tag.attribute("NumberOfComponents") ? vtkXmlCount(file, tag, "NumberOfComponents") : 1;
  if (components < 1 || components > std::numeric_limits<std::int16_t>::max())
  {
    file.fail(tag.begin, "an array cannot have " + std::to_string(components) + " components");
  }
  array.components = static_cast<int>(components);
  const std::string format = tag.value("format", "ascii");
  if (format != "ascii" && format != "binary" && format != "appended")
  {
    file.fail(tag.begin,
      "the array here has the format " + inQuotes(format) + ", not ascii, binary or appended");
  }
  if (format == "ascii")
  {
    return array;
  }
  array.headerBytes = encoding.headerBytes;
  array.compression = encoding.compression;
  array.encoding = VtkEncoding::Base64;
  if (format == "appended")
  {
    // The offset and the encoding of the appended data follow after all arrays.
    array.encoding = VtkEncoding::Raw;
    array.begin = static_cast<std::size_t>(vtkXmlCount(file, tag, "offset"));
  }
  return array;
}

std::int64_t vtkXmlCount(const InputFile& file, const XmlTag& tag, const char* name)
{
  const std::string text = tag.value(name, "0");
  std::string_view digits = text;
  digits.remove_prefix(std::min(digits.find_first_not_of(" \t\r\n"), digits.size()));
  digits = digits.substr(0, digits.find_first_of(" \t\r\n"));
  std::int64_t value = -1;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || stop != digits.data() + digits.size() || value < 0 ||
      value > MostThings)
  {
    file.fail(tag.begin, inQuotes(text) + " cannot be the " + name + " of the tag here");
  }
  return value;
}

} // namespace smg
