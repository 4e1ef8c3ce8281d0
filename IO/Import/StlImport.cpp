// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/CellCollector.h"
#include "IO/Import/Formats.h"
#include "IO/Import/TextScanner.h"

#include "Solver/Core/Error.h"

#include <array>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace smg
{

namespace
{

constexpr std::size_t BinaryHeader = 84;
constexpr std::size_t BinaryTriangle = 50;

using Point = std::array<float, 3>;

struct PointHash
{
  std::size_t operator()(const Point& point) const
  {
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const float coordinate : point)
    {
      std::uint32_t bits;
      std::memcpy(&bits, &coordinate, sizeof(bits));
      hash = (hash ^ bits) * 0xff51afd7ed558ccdu;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

/** Makes one vertex of all corners with the same coordinates. */
class Welder
{
public:
  /** `sizes`: what is expected; when more vertices come, the budget is asked again. */
  Welder(const std::filesystem::path& path, const MemoryBudget& budget, const MeshSizes& sizes)
    : Path(path)
    , Budget(budget)
    , Sizes(sizes)
  {
    budget.check(path, sizes);
  }

  std::int64_t vertex(Point point)
  {
    for (float& coordinate : point)
    {
      coordinate += 0.0f; // -0 and 0 are the same place
    }
    const auto [entry, fresh] =
      this->Vertices.try_emplace(point, static_cast<std::int64_t>(this->Vertices.size()));
    if (fresh)
    {
      if (entry->second >= this->Sizes.vertices)
      {
        this->Sizes.vertices *= 2;
        this->Budget.check(this->Path, this->Sizes);
      }
      this->Positions.insert(this->Positions.end(), point.begin(), point.end());
    }
    return entry->second;
  }

  std::vector<double> positions() { return std::move(this->Positions); }

private:
  const std::filesystem::path& Path;
  const MemoryBudget& Budget;
  MeshSizes Sizes;
  std::unordered_map<Point, std::int64_t, PointHash> Vertices;
  std::vector<double> Positions;
};

std::uint32_t littleEndian(const char* bytes)
{
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i)
  {
    value = value << 8 | static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

bool isBinary(const InputFile& file)
{
  return file.size() >= BinaryHeader &&
         (file.size() == BinaryHeader + BinaryTriangle * littleEndian(file.begin() + 80) ||
           !file.text().starts_with("solid"));
}

void readBinary(InputFile& file, Welder& welder, CellCollector& cells)
{
  const std::size_t triangles = littleEndian(file.begin() + 80);
  const std::size_t expected = BinaryHeader + BinaryTriangle * triangles;
  if (file.size() < expected)
  {
    throw Error(file.path().string() + ": the file is truncated: " + std::to_string(triangles) +
                " triangles take " + std::to_string(expected) + " bytes, it has " +
                std::to_string(file.size()) + '.');
  }
  for (std::size_t i = 0; i < triangles; ++i)
  {
    const std::size_t offset = BinaryHeader + BinaryTriangle * i;
    std::array<std::int64_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      Point point;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const std::uint32_t bits = littleEndian(file.begin() + offset + 12 + 12 * k + 4 * axis);
        std::memcpy(&point[axis], &bits, sizeof(bits));
        if (!std::isfinite(point[axis]))
        {
          file.fail(offset, "a coordinate of triangle " + std::to_string(i) + " is not finite");
        }
      }
      corners[k] = welder.vertex(point);
    }
    cells.triangle(corners[0], corners[1], corners[2]);
    file.passed(offset);
  }
}

void readText(InputFile& file, Welder& welder, CellCollector& cells)
{
  TextScanner scanner(file);
  std::vector<std::int64_t> polygon;
  bool inside = false;
  bool ended = false;
  while (!scanner.atEnd())
  {
    const std::string_view keyword = scanner.tokenInLine();
    if (keyword == "vertex")
    {
      Point point;
      for (float& coordinate : point)
      {
        coordinate =
          static_cast<float>(scanner.toNumber(scanner.tokenInLine(), "a coordinate of a vertex"));
      }
      if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
      {
        scanner.fail("a coordinate is beyond the range of single precision");
      }
      polygon.push_back(welder.vertex(point));
    }
    else if (keyword == "outer")
    {
      polygon.clear();
      inside = true;
    }
    else if (keyword == "endloop")
    {
      cells.polygon(polygon);
      inside = false;
    }
    else if (keyword != "solid" && keyword != "facet" && keyword != "endfacet" &&
             keyword != "endsolid")
    {
      scanner.fail(inQuotes(keyword) + " is not a keyword of an STL file");
    }
    ended = keyword == "endsolid";
    scanner.skipLine();
  }
  if (inside || !ended)
  {
    scanner.fail("the file is truncated: it must end with 'endsolid'");
  }
}

} // namespace

IndexedMesh importStl(InputFile& file, const ImportOptions& options)
{
  const bool binary = isBinary(file);
  if (!binary && !file.text().starts_with("solid"))
  {
    throw Error(file.path().string() + ": the file is too short for an STL file.");
  }
  // A triangle's text takes some 200 bytes, and a closed mesh has half as many vertices as
  // triangles; the welder looks after meshes that have more. The table of the welded corners counts
  // as attributes.
  MeshSizes sizes;
  sizes.cells = static_cast<std::int64_t>(file.size() / (binary ? BinaryTriangle : 200));
  sizes.vertices = sizes.cells / 2 + 2;
  sizes.vertexColumnBytes = 56;
  Welder welder(file.path(), options.budget, sizes);
  CellCollector cells;
  binary ? readBinary(file, welder, cells) : readText(file, welder, cells);
  IndexedMesh mesh;
  mesh.doublePositions = false;
  mesh.positions = welder.positions();
  cells.finish(mesh);
  return mesh;
}

} // namespace smg
