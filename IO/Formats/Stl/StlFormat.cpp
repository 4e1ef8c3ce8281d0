// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Stl/StlFormat.h"

#include "IO/Export/MeshFileWriter.h"
#include "IO/Export/PlacedColumns.h"
#include "IO/External/ExternalSort.h"
#include "IO/Files/ByteOrder.h"
#include "IO/Files/TextOutput.h"
#include "IO/Files/TextScanner.h"
#include "Solver/Core/Vector.h"
#include "smg/Error.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

namespace smg
{

namespace
{

using Position = std::array<double, 3>;
using Triangle = std::array<Position, 3>;

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

/**
 * Triangles with the coordinates of their corners, joined out of core: binary if these are single
 * precision numbers and text is not requested, else text, which holds them exactly. There is no
 * place for isolated vertices.
 */
class StlWriter : public MeshFileWriter
{
public:
  StlWriter(std::filesystem::path path, const MeshFileInfo& info, Workspace& space)
    : Path(std::move(path))
    , Info(info)
    , Sorted(space, space.available() / 3, sizeof(Position))
    , ByVertex(std::in_place, space, space.available() / 3, sizeof(std::uint64_t))
  {
    if (!this->isText() && info.cells > std::int64_t(UINT32_MAX))
    {
      throw Error(this->Path.string() +
                  ": a binary .stl file has room for 4294967295 triangles, but there are " +
                  std::to_string(info.cells) + ": choose .ply or .vtp.");
    }
  }

  /** The corners are sorted by vertex, to join the coordinates, then by their own positions. */
  void elements(const ElementChunk& chunk) override
  {
    chunk.forEachUpTo(3,
      [this](std::span<const std::int64_t> triangle, std::size_t)
      {
        for (const std::int64_t vertex : triangle)
        {
          std::byte* const row = this->ByVertex->put(static_cast<std::uint64_t>(vertex));
          std::memcpy(row, &this->Corners, sizeof(this->Corners));
          ++this->Corners;
        }
      });
  }

  void vertices(const VertexChunk& chunk) override
  {
    if (chunk.first == 0)
    {
      this->ByVertex->sort();
      this->More = this->ByVertex->next(this->Corner);
    }
    const auto first = static_cast<std::uint64_t>(chunk.first);
    const std::uint64_t end = first + static_cast<std::uint64_t>(chunk.count());
    for (; this->More && this->Corner.key < end; this->More = this->ByVertex->next(this->Corner))
    {
      std::uint64_t corner = 0;
      std::memcpy(&corner, this->Corner.bytes, sizeof(corner));
      std::memcpy(this->Sorted.put(corner), &chunk.positions[3 * (this->Corner.key - first)],
        sizeof(Position));
    }
  }

  WriteNotes finish() override
  {
    this->Sorted.sort();
    this->ByVertex.reset();
    this->isText() ? this->writeText() : this->writeBinary();
    return PlacedColumns(this->Info).leftOut(".stl");
  }

private:
  bool isText() const { return this->Info.doublePositions || this->Info.text; }

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

  void writeBinary()
  {
    SequentialOutput out(this->Path);
    std::array<std::byte, 80> title{}; // must not begin like a text file
    out.put(title);
    const auto put = [&out](auto scalars)
    {
      const std::span<std::byte> bytes = std::as_writable_bytes(std::span(scalars));
      toByteOrder(std::endian::little, bytes, sizeof(scalars[0]));
      out.put(bytes);
    };
    put(std::array{ static_cast<std::uint32_t>(this->Info.cells) });
    for (Triangle triangle; this->next(triangle);)
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

  void writeText()
  {
    TextOutput out(this->Path);
    out << "solid mesh\n";
    for (Triangle triangle; this->next(triangle);)
    {
      const std::array<float, 3> normal = normalOf(triangle);
      out << "facet normal " << normal[0] << ' ' << normal[1] << ' ' << normal[2]
          << "\nouter loop\n";
      for (const Position& position : triangle)
      {
        out << "vertex ";
        out.position(position, this->Info.doublePositions);
        out << '\n';
      }
      out << "endloop\nendfacet\n";
    }
    out << "endsolid mesh\n";
    out.finish();
  }

  std::filesystem::path Path;
  const MeshFileInfo Info;
  RowSort Sorted;                  ///< positions of corners, by corner
  std::optional<RowSort> ByVertex; ///< corners, by vertex
  std::uint64_t Corners = 0;
  RowSort::Row Corner;
  bool More = false; ///< whether there is such a corner
};

std::unique_ptr<MeshFileWriter> makeStlWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* space)
{
  return std::make_unique<StlWriter>(path, info, *space);
}

/** The corners are sorted by vertices, then with coordinates by triangles. */
std::int64_t scratchOfStl(const StreamInfo& mesh, std::int64_t memory, bool)
{
  constexpr std::int64_t NumbersBytes = 2 * sizeof(std::uint32_t);
  const std::int64_t corners = mesh.cells * cornersOf(mesh.cellType);
  return rowSortBytes(corners, NumbersBytes, memory / 3) +
         rowSortBytes(corners, sizeof(Position), memory / 3);
}

std::int64_t bytesOfStl(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  constexpr std::int64_t BinaryBytes = 50;
  constexpr double Words = 63; // of a facet as text
  const double numbers = positionCharacters(false) + 3 * positionCharacters(mesh.doublePositions);
  return mesh.doublePositions || written.text ? textBytes(mesh.cells, Words + numbers)
                                              : mesh.cells * BinaryBytes;
}

bool looksLikeStl(std::string_view start, std::optional<std::uint64_t> size)
{
  return (size && isBinaryStl(start, *size)) || isTextStl(textStart(start));
}

constexpr FileSuffix StlSuffixes[] = { { ".stl", true, false, FileForm::Either } };

} // namespace

const Format StlFormat{
  .name = "STL",
  .suffixes = StlSuffixes,
  .description = "text and binary; written as text also where coordinates are double precision",
  .cells = "triangles",
  .holdsVertices = false,
  .isReadByVtk = true,
  .looksLike = looksLikeStl,
  .parse = parseWith<importStl>,
  .typicalBytes = { 100, 3 },
  .bytes = bytesOfStl,
  .writer = makeStlWriter,
  .writeOrder = WriteOrder::ElementsFirst,
  .scratch = scratchOfStl,
  .maxCorners = 3,
};

} // namespace smg
