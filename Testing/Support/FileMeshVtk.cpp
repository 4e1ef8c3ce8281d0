// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/FileCursor.h"

namespace smg::testing
{

namespace
{

std::string decodeBase64(const std::string& text)
{
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text)
  {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos)
    {
      bits = count = 0; // padding: another unit may follow
      continue;
    }
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8)
    {
      count -= 8;
      bytes += static_cast<char>(bits >> count & 0xff);
    }
  }
  return bytes;
}

std::string attribute(const std::string& tag, const std::string& name)
{
  const std::size_t begin = tag.find(name + "=\"") + name.size() + 2;
  return tag.substr(begin, tag.find('"', begin) - begin);
}

} // namespace

FileMesh readVtk(FileCursor in)
{
  FileMesh mesh;
  const std::endian order = std::endian::big;
  in.line();
  in.line();
  in.expect("BINARY");
  in.expect("DATASET");
  std::map<std::string, std::vector<double>>* data = nullptr;
  std::int64_t tuples = 0;
  const auto readArray =
    [&](const std::string& name, std::int64_t components, const std::string& type)
  {
    for (std::int64_t i = 0; i < components * tuples; ++i)
    {
      (*data)[name].push_back(in.binary(type, order));
    }
  };
  for (in.word(); !in.atEnd();)
  {
    const std::string keyword = in.word();
    if (keyword == "FIELD")
    {
      in.expect("FieldData");
      for (std::int64_t fields = in.integer(); fields > 0; --fields)
      {
        const std::string name = in.word();
        const std::int64_t components = in.integer();
        tuples = in.integer();
        readArray(name, components, in.line().substr(1));
      }
      continue;
    }
    if (keyword == "NORMALS" || keyword == "TEXTURE_COORDINATES")
    {
      const std::string name = in.word();
      const std::int64_t components = keyword == "NORMALS" ? 3 : in.integer();
      readArray(name, components, in.line().substr(1));
      continue;
    }
    const std::int64_t count = in.integer();
    if (keyword == "POINT_DATA" || keyword == "CELL_DATA")
    {
      data = keyword == "POINT_DATA" ? &mesh.pointData : &mesh.cellData;
      tuples = count;
      continue;
    }
    const std::string rest = in.line();
    for (std::int64_t i = 0; i < count; ++i)
    {
      if (keyword == "POINTS")
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          mesh.points.push_back(in.binary(rest.substr(1), order));
        }
      }
      else if (keyword == "CELL_TYPES")
      {
        if (in.binary<std::int32_t>(order) != 10)
        {
          throw std::runtime_error("a cell that is no tetrahedron");
        }
      }
      else
      {
        mesh.cells.emplace_back();
        for (auto n = in.binary<std::int32_t>(order); n > 0; --n)
        {
          mesh.cells.back().push_back(in.binary<std::int32_t>(order));
        }
      }
    }
  }
  return mesh;
}

FileMesh readVtkXml(const std::string& text)
{
  const std::map<std::string, std::string> types{ { "Float32", "float" }, { "Float64", "double" },
    { "Int64", "vtktypeint64" }, { "UInt8", "uchar" }, { "Int32", "int" } };
  FileMesh mesh;
  std::map<std::string, std::vector<double>> frame;
  const std::size_t cellData = text.find("<CellData>");
  const std::size_t points = text.find("<Points>");
  for (std::size_t at = text.find("<DataArray"); at != std::string::npos;
       at = text.find("<DataArray", at + 1))
  {
    const std::size_t begin = text.find('>', at) + 1;
    const std::string tag = text.substr(at, begin - at);
    const std::string bytes = decodeBase64(text.substr(begin, text.find('<', begin) - begin));
    auto& target = at < cellData ? mesh.pointData : at < points ? mesh.cellData : frame;
    std::vector<double>& values = target[attribute(tag, "Name")];
    FileCursor in(bytes);
    const auto size = in.binary<std::uint64_t>(std::endian::native);
    if (size + sizeof(size) != bytes.size())
    {
      throw std::runtime_error("an array that is not as long as it says");
    }
    const std::string type = types.at(attribute(tag, "type"));
    const std::size_t scalar = type == "float" || type == "int" ? 4 : type == "uchar" ? 1 : 8;
    for (std::uint64_t i = 0; i < size / scalar; ++i)
    {
      values.push_back(in.binary(type, std::endian::native));
    }
  }
  mesh.points = frame.at("Points");
  std::size_t begin = 0;
  for (std::size_t cell = 0; cell < frame.at("offsets").size(); ++cell)
  {
    const auto end = static_cast<std::size_t>(frame.at("offsets")[cell]);
    const auto corners = frame.at("connectivity").begin();
    mesh.cells.emplace_back(corners + std::ptrdiff_t(begin), corners + std::ptrdiff_t(end));
    begin = end;
    if (!frame.contains("types"))
    {
      continue;
    }
    const double kind = frame.at("types")[cell];
    const std::size_t size = mesh.cells.back().size();
    if (kind != (size == 3 ? 5 : size == 4 ? 9 : 7) && !(kind == 10 && size == 4))
    {
      throw std::runtime_error("a cell of a kind that it is not");
    }
  }
  return mesh;
}

} // namespace smg::testing
