// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/VtkXmlArrays.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>

namespace smg
{

namespace
{

/** The value of an attribute of a tag; empty if the tag does not have it. */
std::string_view attribute(std::string_view tag, std::string_view name)
{
  for (std::size_t at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1))
  {
    const std::size_t quote = at + name.size() + 1;
    const bool found = tag[at - 1] <= ' ' && quote < tag.size() && tag[quote - 1] == '=' &&
                       (tag[quote] == '"' || tag[quote] == '\'');
    if (found)
    {
      const std::string_view value = tag.substr(quote + 1);
      return value.substr(0, value.find(tag[quote]));
    }
  }
  return {};
}

/** Bytes of a value of a type, as "Float32" or "UInt8"; texts and unknown types count as 8. */
std::int64_t bytesOfType(std::string_view type)
{
  return type.ends_with("Int8") ? 1 : type.ends_with("16") ? 2 : type.ends_with("32") ? 4 : 8;
}

} // namespace

VtkXmlArrays vtkXmlArrays(const InputFile& file, std::string_view text, std::uint64_t most)
{
  VtkXmlArrays largest;
  VtkXmlArrays piece;
  std::int64_t* section = nullptr;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1))
  {
    const std::string_view rest = text.substr(at);
    const std::string_view tag = rest.substr(0, rest.find('>'));
    if (tag.starts_with("<Piece"))
    {
      piece = {};
    }
    else if (tag.starts_with("<PointData"))
    {
      section = &piece.pointBytes;
    }
    else if (tag.starts_with("<CellData"))
    {
      section = &piece.cellBytes;
    }
    else if (tag.starts_with("</PointData") || tag.starts_with("</CellData"))
    {
      section = nullptr;
    }
    else if (tag.starts_with("<DataArray"))
    {
      const std::string_view components = attribute(tag, "NumberOfComponents");
      std::uint64_t count = 1;
      const char* const end = components.data() + components.size();
      const auto [stop, error] = std::from_chars(components.data(), end, count);
      const bool given = !components.empty();
      if (given && (error != std::errc() || stop != end || count < 1 || count > most))
      {
        file.fail(at, "the number of components of this array cannot be: it is wrong");
      }
      if (section)
      {
        *section += static_cast<std::int64_t>(count) * bytesOfType(attribute(tag, "type"));
      }
    }
    largest.pointBytes = std::max(largest.pointBytes, piece.pointBytes);
    largest.cellBytes = std::max(largest.cellBytes, piece.cellBytes);
  }
  return largest;
}

} // namespace smg
