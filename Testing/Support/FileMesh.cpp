// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/FileMesh.h"

#include "Testing/Support/FileCursor.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

namespace smg::testing
{

namespace
{

std::string contentOf(const std::filesystem::path& path)
{
  std::ifstream in(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(in), {} };
}

FileMesh readObj(FileCursor in)
{
  FileMesh mesh;
  while (!in.atEnd())
  {
    std::istringstream line(in.line());
    std::string keyword;
    line >> keyword;
    if (keyword == "f")
    {
      mesh.cells.emplace_back();
      // As 7, 7/7, 7//7 or 7/7/7.
      for (std::string corner; line >> corner;)
      {
        mesh.cells.back().push_back(std::stoll(corner) - 1);
      }
      continue;
    }
    const std::vector<double> numbers{ std::istream_iterator<double>(line), {} };
    std::vector<double>& to = keyword == "v" ? mesh.points : mesh.pointData[keyword];
    // A colour may follow a point.
    to.insert(to.end(), numbers.begin(), keyword == "v" ? numbers.begin() + 3 : numbers.end());
  }
  return mesh;
}

/** With any attributes after the coordinates and corners. */
FileMesh readOff(FileCursor in)
{
  FileMesh mesh;
  if (!in.line().ends_with("OFF"))
  {
    throw std::runtime_error("no OFF file");
  }
  std::istringstream counts(in.line());
  std::int64_t points = 0, cells = 0;
  counts >> points >> cells;
  for (; points > 0; --points)
  {
    std::istringstream line(in.line());
    std::copy_n(std::istream_iterator<double>(line), 3, std::back_inserter(mesh.points));
  }
  for (; cells > 0; --cells)
  {
    std::istringstream line(in.line());
    std::int64_t corners = 0;
    line >> corners;
    mesh.cells.emplace_back();
    std::copy_n(
      std::istream_iterator<std::int64_t>(line), corners, std::back_inserter(mesh.cells.back()));
  }
  return mesh;
}

FileMesh readMedit(FileCursor in)
{
  FileMesh mesh;
  const std::map<std::string, int> corners{ { "Triangles", 3 }, { "Quadrilaterals", 4 },
    { "Tetrahedra", 4 } };
  in.expect("MeshVersionFormatted");
  in.integer();
  in.expect("Dimension");
  in.expect("3");
  in.expect("Vertices");
  for (std::int64_t count = in.integer(); count > 0; --count)
  {
    in.points(1, mesh);
    in.integer();
  }
  for (std::string keyword = in.word(); keyword != "End"; keyword = in.word())
  {
    for (std::int64_t count = in.integer(); count > 0; --count)
    {
      in.cell(corners.at(keyword), 1, mesh);
      in.integer();
    }
  }
  return mesh;
}

FileMesh readGmsh(FileCursor in)
{
  FileMesh mesh;
  const std::map<int, int> corners{ { 2, 3 }, { 3, 4 }, { 4, 4 } };
  for (const char* word : { "$MeshFormat", "2.2", "0", "8", "$EndMeshFormat", "$Nodes" })
  {
    in.expect(word);
  }
  const std::int64_t points = in.integer();
  for (std::int64_t i = 0; i < points; ++i)
  {
    in.expect(std::to_string(i + 1));
    in.points(1, mesh);
  }
  in.expect("$EndNodes");
  in.expect("$Elements");
  const std::int64_t cells = in.integer();
  for (std::int64_t i = 0; i < cells; ++i)
  {
    in.expect(std::to_string(i + 1));
    const int type = static_cast<int>(in.integer());
    for (std::int64_t tags = in.integer(); tags > 0; --tags)
    {
      in.integer();
    }
    in.cell(corners.at(type), 1, mesh);
  }
  in.expect("$EndElements");
  return mesh;
}

FileMesh readAbaqus(FileCursor in)
{
  FileMesh mesh;
  std::string keyword;
  while (!in.atEnd())
  {
    std::string line = in.line();
    if (line.starts_with('*'))
    {
      keyword = line.substr(0, line.find(','));
      continue;
    }
    std::ranges::replace(line, ',', ' ');
    std::istringstream words(line);
    std::int64_t label = 0;
    words >> label;
    if (keyword == "*NODE")
    {
      std::copy(std::istream_iterator<double>(words), {}, std::back_inserter(mesh.points));
    }
    else if (keyword == "*ELEMENT")
    {
      mesh.cells.emplace_back();
      for (std::int64_t corner = 0; words >> corner;)
      {
        mesh.cells.back().push_back(corner - 1);
      }
    }
  }
  return mesh;
}

FileMesh readPly(FileCursor in)
{
  struct Property
  {
    std::string type, name, countType;
  };
  FileMesh mesh;
  std::int64_t counts[2] = {};
  std::vector<Property> properties[2];
  int element = -1;
  for (std::string line = in.line(); line != "end_header"; line = in.line())
  {
    std::istringstream words(line);
    std::string keyword, type, name;
    words >> keyword >> type;
    if (keyword == "element")
    {
      words >> counts[++element];
    }
    else if (keyword == "property" && type == "list")
    {
      Property property;
      words >> property.countType >> property.type >> property.name;
      properties[element].push_back(property);
    }
    else if (keyword == "property")
    {
      words >> name;
      properties[element].push_back({ type, name, "" });
    }
  }
  const std::endian order = std::endian::native;
  for (int e = 0; e < 2; ++e)
  {
    for (std::int64_t i = 0; i < counts[e]; ++i)
    {
      for (const Property& property : properties[e])
      {
        if (!property.countType.empty())
        {
          mesh.cells.emplace_back();
          for (auto n = in.binary(property.countType, order); n > 0; --n)
          {
            mesh.cells.back().push_back(static_cast<std::int64_t>(in.binary(property.type, order)));
          }
          continue;
        }
        const double value = in.binary(property.type, order);
        const bool isPosition =
          property.name == "x" || property.name == "y" || property.name == "z";
        (isPosition ? mesh.points : (e == 0 ? mesh.pointData : mesh.cellData)[property.name])
          .push_back(value);
      }
    }
  }
  return mesh;
}

} // namespace

namespace
{

/** The header and numbers of a classic netCDF file of 64-bit offsets. */
class NetCdfCursor
{
public:
  explicit NetCdfCursor(const std::string& file)
    : File(file)
  {
    if (!file.starts_with("CDF\2"))
    {
      throw std::runtime_error("no netCDF file of 64-bit offsets");
    }
    for (std::uint64_t count = this->list(); count > 0; --count)
    {
      this->name();
      this->Extents.push_back(this->number(4));
    }
    this->skipAttributes();
    for (std::uint64_t count = this->list(); count > 0; --count)
    {
      this->readVariable();
    }
  }

  bool has(const std::string& name) const { return this->Variables.contains(name); }
  std::uint64_t extent(const std::string& name, std::size_t k) const
  {
    return this->Variables.at(name).extents.at(k);
  }
  std::vector<double> values(const std::string& name)
  {
    const Variable& variable = this->Variables.at(name);
    std::vector<double> values;
    const std::size_t size = variable.type == 6 ? 8 : 4;
    std::uint64_t count = 1;
    for (const std::uint64_t extent : variable.extents)
    {
      count *= extent;
    }
    this->At = variable.begin;
    for (; count > 0; --count)
    {
      const std::uint64_t bits = this->number(size);
      values.push_back(variable.type == 6   ? std::bit_cast<double>(bits)
                       : variable.type == 5 ? std::bit_cast<float>(std::uint32_t(bits))
                                            : static_cast<double>(std::int32_t(bits)));
    }
    return values;
  }

private:
  struct Variable
  {
    std::vector<std::uint64_t> extents;
    std::uint64_t type, begin;
  };

  std::uint64_t number(std::size_t bytes)
  {
    std::uint64_t value = 0;
    for (; bytes > 0; --bytes)
    {
      value = value << 8 | static_cast<unsigned char>(this->File.at(this->At++));
    }
    return value;
  }
  std::uint64_t list()
  {
    this->number(4);
    return this->number(4);
  }
  std::string name()
  {
    const std::uint64_t size = this->number(4), begin = this->At;
    this->At += (size + 3) / 4 * 4;
    return this->File.substr(begin, size);
  }
  void skipAttributes()
  {
    for (std::uint64_t count = this->list(); count > 0; --count)
    {
      this->name();
      const std::uint64_t bytes = this->number(4) == 2 ? 1 : 4;
      this->At += (this->number(4) * bytes + 3) / 4 * 4;
    }
  }
  void readVariable()
  {
    const std::string name = this->name();
    Variable variable;
    for (std::uint64_t rank = this->number(4); rank > 0; --rank)
    {
      variable.extents.push_back(this->Extents.at(this->number(4)));
    }
    this->skipAttributes();
    variable.type = this->number(4);
    this->number(4);
    variable.begin = this->number(8);
    this->Variables[name] = variable;
  }

  const std::string& File;
  std::size_t At = 8;
  std::vector<std::uint64_t> Extents;
  std::map<std::string, Variable> Variables;
};

/** Points and the blocks of elements. */
FileMesh readExodus(const std::string& text)
{
  NetCdfCursor in(text);
  FileMesh mesh;
  const std::vector<double> axes[] = { in.values("coordx"), in.values("coordy"),
    in.values("coordz") };
  for (std::size_t i = 0; i < axes[0].size(); ++i)
  {
    for (const std::vector<double>& axis : axes)
    {
      mesh.points.push_back(axis[i]);
    }
  }
  for (int block = 1; in.has("connect" + std::to_string(block)); ++block)
  {
    const std::string name = "connect" + std::to_string(block);
    const std::vector<double> numbers = in.values(name);
    const std::size_t corners = in.extent(name, 1);
    for (std::size_t i = 0; i < numbers.size(); i += corners)
    {
      std::vector<std::int64_t>& cell = mesh.cells.emplace_back();
      for (std::size_t k = 0; k < corners; ++k)
      {
        cell.push_back(static_cast<std::int64_t>(numbers[i + k]) - 1);
      }
    }
  }
  return mesh;
}

bool isOfExodus(const std::string& suffix)
{
  return suffix == ".e" || suffix == ".exo" || suffix == ".ex2" || suffix == ".g";
}

} // namespace

FileMesh readFileMesh(const std::filesystem::path& path)
{
  const std::string suffix = path.extension().string();
  const std::string text = contentOf(path);
  return isOfExodus(suffix)  ? readExodus(text)
         : suffix == ".ply"  ? readPly(FileCursor(text))
         : suffix == ".obj"  ? readObj(FileCursor(text))
         : suffix == ".off"  ? readOff(FileCursor(text))
         : suffix == ".mesh" ? readMedit(FileCursor(text))
         : suffix == ".msh"  ? readGmsh(FileCursor(text))
         : suffix == ".inp"  ? readAbaqus(FileCursor(text))
         : suffix == ".vtk"  ? readVtk(FileCursor(text))
                             : readVtkXml(text);
}

std::vector<double> readStlPoints(const std::filesystem::path& path)
{
  const std::string text = contentOf(path);
  std::vector<double> points;
  if (text.starts_with("solid"))
  {
    FileCursor in(text);
    while (!in.atEnd())
    {
      if (in.word() == "vertex")
      {
        points.push_back(in.number());
        points.push_back(in.number());
        points.push_back(in.number());
      }
    }
    return points;
  }
  FileCursor in(text.substr(80));
  const auto count = in.binary<std::uint32_t>(std::endian::little);
  if (text.size() != 84 + std::size_t(50) * count)
  {
    throw std::runtime_error("a binary STL file that is not as long as it says");
  }
  for (std::uint32_t i = 0; i < count; ++i)
  {
    for (int k = 0; k < 12; ++k)
    {
      const auto value = in.binary<float>(std::endian::little);
      if (k >= 3)
      {
        points.push_back(value);
      }
    }
    in.binary<std::uint16_t>(std::endian::little);
  }
  return points;
}

} // namespace smg::testing
