// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/PlacedColumns.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/External/RowSort.h"
#include "IO/Files/ByteOrder.h"
#include "IO/Files/TextBytes.h"
#include "IO/Files/TextOutput.h"
#include "IO/Formats/Stl/StlFormat.h"
#include "Solver/Core/Vector.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace smg
{

namespace
{

using Position = std::array<double, 3>;
using Triangle = std::array<Position, 3>;

/** The triangles of a mesh with the coordinates of their corners, joined out of core. */
class TrianglePositions
{
public:
  TrianglePositions(RestoredMesh& mesh, Workspace& workspace)
    : Sorted(workspace, workspace.available() / 3, sizeof(Position))
  {
    // Sorts the corners by vertex, to join the coordinates, then by their own positions.
    RowSort byVertex(workspace, workspace.available() / 3, sizeof(std::uint64_t));
    std::uint64_t corner = 0;
    const auto put = [&](std::int64_t vertex)
    {
      std::memcpy(byVertex.put(static_cast<std::uint64_t>(vertex)), &corner, sizeof(corner));
      ++corner;
    };
    for (RestoredElements elements; mesh.next(elements);)
    {
      elements.forEachTriangle(
        [&put](const auto& triangle) { std::ranges::for_each(triangle, put); });
    }
    byVertex.sort();
    RowSort::Row row;
    bool more = byVertex.next(row);
    for (RestoredVertices vertices; mesh.next(vertices);)
    {
      const auto end = static_cast<std::uint64_t>(vertices.first + vertices.count());
      for (; more && row.key < end; more = byVertex.next(row))
      {
        const std::size_t place = row.key - static_cast<std::uint64_t>(vertices.first);
        std::memcpy(&corner, row.bytes, sizeof(corner));
        std::memcpy(this->Sorted.put(corner), &vertices.positions[3 * place], sizeof(Position));
      }
    }
    this->Sorted.sort();
  }

  /** The next triangle; returns false at the end. */
  bool next(Triangle& triangle)
  {
    RowSort::Row row;
    for (Position& position : triangle)
    {
      if (!this->Sorted.next(row))
      {
        return false;
      }
      std::memcpy(position.data(), row.bytes, sizeof(position));
    }
    return true;
  }

private:
  RowSort Sorted;
};

/** The unit normal; zero if the triangle has no area. */
std::array<float, 3> normalOf(const Triangle& t)
{
  const Vector n =
    cross(difference(t[1].data(), t[0].data()), difference(t[2].data(), t[0].data()));
  const double length = std::hypot(n[0], n[1], n[2]);
  if (!(length > 0) || !std::isfinite(length))
  {
    return {};
  }
  return { static_cast<float>(n[0] / length), static_cast<float>(n[1] / length),
    static_cast<float>(n[2] / length) };
}

void writeBinary(
  TrianglePositions& triangles, std::int64_t count, const std::filesystem::path& path)
{
  if (count > std::int64_t(UINT32_MAX))
  {
    throw Error(path.string() +
                ": a binary .stl file has room for 4294967295 triangles, but there "
                "are " +
                std::to_string(count) + ": choose .ply or .vtp.");
  }
  SequentialOutput out(path);
  std::array<std::byte, 80> title{}; // must not begin like a text file
  out.put(title);
  const auto put = [&out](auto scalars)
  {
    const std::span<std::byte> bytes = std::as_writable_bytes(std::span(scalars));
    toByteOrder(std::endian::little, bytes, sizeof(scalars[0]));
    out.put(bytes);
  };
  put(std::array{ static_cast<std::uint32_t>(count) });
  for (Triangle triangle; triangles.next(triangle);)
  {
    put(normalOf(triangle));
    for (const Position& position : triangle)
    {
      put(std::array{ static_cast<float>(position[0]), static_cast<float>(position[1]),
        static_cast<float>(position[2]) });
    }
    put(std::array<std::uint16_t, 1>{});
  }
  out.finish();
}

void writeText(TrianglePositions& triangles, const std::filesystem::path& path)
{
  TextOutput out(path);
  out << "solid mesh\n";
  for (Triangle triangle; triangles.next(triangle);)
  {
    const std::array<float, 3> normal = normalOf(triangle);
    out << "facet normal " << normal[0] << ' ' << normal[1] << ' ' << normal[2] << "\nouter loop\n";
    for (const Position& position : triangle)
    {
      out << "vertex ";
      out.position(position, true);
      out << '\n';
    }
    out << "endloop\nendfacet\n";
  }
  out << "endsolid mesh\n";
  out.finish();
}

} // namespace

WriteNotes writeRestoredStl(RestoredMesh& mesh, const std::filesystem::path& path)
{
  const RestoredInfo& info = mesh.info();
  TrianglePositions triangles(mesh, mesh.workspace());
  info.doublePositions ? writeText(triangles, path) : writeBinary(triangles, info.cells, path);
  WriteNotes notes = PlacedColumns(info).leftOut(".stl");
  if (info.isolated > 0)
  {
    notes.push_back("The " + std::to_string(info.isolated) +
                    " isolated vertices are left out, since STL has only triangles.");
  }
  if (info.mostCorners > 3)
  {
    notes.push_back("Polygons are written as triangles.");
  }
  return notes;
}

std::int64_t bytesOfStl(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  constexpr std::int64_t BinaryBytes = 50;
  constexpr double Words = 63; // of a facet as text
  return mesh.doublePositions
           ? textBytes(mesh.cells, Words + positionCharacters(false) + 3 * positionCharacters(true))
           : mesh.cells * BinaryBytes;
}

} // namespace smg
