// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Random/Case.h"

#include "IO/Mesh/GroupsJson.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

namespace smg::testing
{
using nlohmann::json;

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CaseColumn, name, components, values, isInteger)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(CaseRun, blockCells, threads, inCore, coreNodes,
  blockNodes, sweeps, acceleration, cancelAt, isKilled, memory, door, order, unused, pieces,
  relation)

namespace
{

constexpr double Flat = 1e-13;

/** The groups as field data of a legacy file, in which characters other than letters and digits are
 * %XX. */
std::string fieldOf(const MeshGroups& groups)
{
  if (groups.empty())
  {
    return {};
  }
  std::ostringstream field;
  field << "FIELD FieldData 1\nMeshGroups 1 1 string\n" << std::hex << std::uppercase;
  for (const char c : textOf(groups))
  {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
    {
      field << c;
    }
    else
    {
      field << '%' << std::setw(2) << std::setfill('0') << static_cast<int>(c);
    }
  }
  field << '\n';
  return field.str();
}

/** Whether a cell has no area or volume, up to the rounding of its coordinates. */
bool isFlat(const Case& given, std::int64_t c)
{
  const auto point = [&](int k)
  { return Eigen::Vector3d::Map(&given.points[3 * static_cast<std::size_t>(given.cell(c)[k])]); };
  const Eigen::Vector3d a = point(1) - point(0), b = point(2) - point(0);
  double longest = std::max({ a.norm(), b.norm(), (a - b).norm() });
  if (given.type == CellType::Triangle)
  {
    return a.cross(b).norm() <= Flat * longest * longest;
  }
  const Eigen::Vector3d d = point(3) - point(0);
  longest = std::max({ longest, d.norm(), (d - a).norm(), (d - b).norm() });
  return std::abs(a.cross(b).dot(d)) <= Flat * longest * longest * longest;
}

std::vector<Column> columnsOf(const std::vector<CaseColumn>& from)
{
  std::vector<Column> columns;
  for (const CaseColumn& column : from)
  {
    if (isGroupColumn(column.name))
    {
      const std::vector<GroupSet> sets(column.values.begin(), column.values.end());
      columns.push_back(makeColumn<GroupSet>(column.name, sets, column.components));
    }
    else if (column.isInteger)
    {
      const std::vector<std::int32_t> numbers(column.values.begin(), column.values.end());
      columns.push_back(makeColumn<std::int32_t>(column.name, numbers, column.components));
    }
    else
    {
      columns.push_back(makeColumn<double>(column.name, column.values, column.components));
    }
  }
  return columns;
}

/** The rows of each column for which `kept` is at least 0, in the order of these numbers. */
std::vector<CaseColumn> chosen(
  const std::vector<CaseColumn>& from, const std::vector<std::int64_t>& rows)
{
  std::vector<CaseColumn> to = from;
  for (CaseColumn& column : to)
  {
    const std::vector<double> values = std::move(column.values);
    column.values.clear();
    for (const std::int64_t row : rows)
    {
      const auto begin = values.begin() + row * column.components;
      column.values.insert(column.values.end(), begin, begin + column.components);
    }
  }
  return to;
}

void writeColumns(std::ofstream& file, const char* owner, std::int64_t rows,
  const std::vector<CaseColumn>& columns, int unused)
{
  if (columns.empty() || rows == 0)
  {
    return;
  }
  rows += unused;
  file << owner << ' ' << rows << "\nFIELD FieldData " << columns.size() << '\n';
  for (const CaseColumn& column : columns)
  {
    const bool isGroups = isGroupColumn(column.name);
    file << column.name << ' ' << column.components << ' ' << rows << ' '
         << (isGroups            ? "unsigned_short"
              : column.isInteger ? "int"
                                 : "double")
         << '\n';
    for (const double value : column.values)
    {
      file << value << '\n';
    }
    for (int k = 0; k < unused * column.components; ++k)
    {
      file << (isGroups ? "0\n" : "1\n");
    }
  }
}

} // namespace

std::vector<std::uint8_t> Case::flags() const
{
  std::vector<std::uint8_t> flags(static_cast<std::size_t>(this->cells()), 0);
  std::set<std::vector<std::int64_t>> seen;
  for (std::int64_t c = 0; c < this->cells(); ++c)
  {
    std::vector<std::int64_t> corners(this->cell(c), this->cell(c) + cornersOf(this->type));
    std::ranges::sort(corners);
    const bool repeats = std::ranges::adjacent_find(corners) != corners.end();
    std::uint8_t& flag = flags[static_cast<std::size_t>(c)];
    flag |= repeats || isFlat(*this, c) ? DegenerateCell : 0;
    flag |= seen.insert(corners).second ? 0 : DuplicateCell;
  }
  return flags;
}

StreamMesh Case::stream() const
{
  StreamMesh mesh;
  mesh.cellType = this->type;
  mesh.positions = this->points;
  mesh.corners = this->corners;
  mesh.groups = this->groups;
  mesh.vertexColumns = columnsOf(this->vertexColumns);
  mesh.cellColumns = columnsOf(this->cellColumns);
  mesh.cellColumns.push_back(makeColumn<std::uint8_t>(CellFlagsName, this->flags()));
  return mesh;
}

Case Case::part(const std::vector<std::uint8_t>& kept) const
{
  std::vector<std::int64_t> cells, vertices;
  std::map<std::int64_t, std::int64_t> numbers;
  Case part = *this;
  part.corners.clear();
  for (std::int64_t c = 0; c < this->cells(); ++c)
  {
    if (!kept[static_cast<std::size_t>(c)])
    {
      continue;
    }
    cells.push_back(c);
    for (int k = 0; k < cornersOf(this->type); ++k)
    {
      const std::int64_t v = this->cell(c)[k];
      const auto [number, isNew] = numbers.try_emplace(v, std::ssize(vertices));
      if (isNew)
      {
        vertices.push_back(v);
      }
      part.corners.push_back(number->second);
    }
  }
  part.points.clear();
  for (const std::int64_t v : vertices)
  {
    part.points.insert(
      part.points.end(), this->points.begin() + 3 * v, this->points.begin() + 3 * v + 3);
  }
  part.vertexColumns = chosen(this->vertexColumns, vertices);
  part.cellColumns = chosen(this->cellColumns, cells);
  return part;
}

void Case::writeVtk(const std::filesystem::path& path) const
{
  std::ofstream file(path);
  file.precision(17);
  const int size = cornersOf(this->type);
  const bool isSurface = this->type == CellType::Triangle;
  file << "# vtk DataFile Version 3.0\nrandom\nASCII\nDATASET "
       << (isSurface ? "POLYDATA\n" : "UNSTRUCTURED_GRID\n") << fieldOf(this->groups) << "POINTS "
       << this->vertices() + this->run.unused << " double\n";
  for (std::size_t k = 0; k < this->points.size(); ++k)
  {
    file << this->points[k] << (k % 3 == 2 ? '\n' : ' ');
  }
  for (int k = 0; k < this->run.unused; ++k)
  {
    file << this->points[0] << ' ' << k << " 0\n";
  }
  file << (isSurface ? "POLYGONS " : "CELLS ") << this->cells() << ' ' << this->cells() * (size + 1)
       << '\n';
  for (std::int64_t c = 0; c < this->cells(); ++c)
  {
    file << size;
    for (int k = 0; k < size; ++k)
    {
      file << ' ' << this->cell(c)[k];
    }
    file << '\n';
  }
  if (!isSurface)
  {
    file << "CELL_TYPES " << this->cells() << '\n';
    for (std::int64_t c = 0; c < this->cells(); ++c)
    {
      file << "10\n";
    }
  }
  writeColumns(file, "POINT_DATA", this->vertices(), this->vertexColumns, this->run.unused);
  writeColumns(file, "CELL_DATA", this->cells(), this->cellColumns, 0);
  if (!file.flush())
  {
    throw std::runtime_error("cannot write " + path.string());
  }
}

void Case::save(const std::filesystem::path& path) const
{
  const json mesh{ { "type", this->type == CellType::Triangle ? "triangles" : "tetrahedra" },
    { "points", this->points }, { "corners", this->corners },
    { "vertexColumns", this->vertexColumns }, { "cellColumns", this->cellColumns },
    { "groups", json::parse(textOf(this->groups)) } };
  std::ofstream file(path);
  file << json{ { "seed", this->seed }, { "job", this->job }, { "mesh", mesh },
    { "problem", this->problem }, { "run", this->run } }
            .dump()
       << '\n';
  if (!file.flush())
  {
    throw std::runtime_error("cannot write " + path.string());
  }
}

Case Case::load(const std::filesystem::path& path)
{
  std::ifstream file(path);
  const json text = json::parse(file);
  const json& mesh = text.at("mesh");
  Case given;
  given.seed = text.at("seed");
  given.job = text.value("job", "solve");
  given.type = mesh.at("type") == "triangles" ? CellType::Triangle : CellType::Tetrahedron;
  mesh.at("points").get_to(given.points);
  mesh.at("corners").get_to(given.corners);
  mesh.at("vertexColumns").get_to(given.vertexColumns);
  mesh.at("cellColumns").get_to(given.cellColumns);
  given.groups = mesh.contains("groups") ? groupsOfText(mesh.at("groups").dump()) : MeshGroups();
  given.problem = text.at("problem");
  text.at("run").get_to(given.run);
  return given;
}

} // namespace smg::testing
