// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/MeshFileWriter.h"
#include "IO/External/BucketFile.h"
#include "IO/External/Workspace.h"
#include "IO/Files/TextOutput.h"
#include "IO/Formats/Vtk/LegacyVtkScanner.h"
#include "IO/Formats/Vtk/VtkCell.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Text.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

namespace
{

/** Columns of vertices or cells, which follow all vertices and cells in the file: kept in a scratch
 * file until then. */
class KeptColumns
{
public:
  KeptColumns(const std::vector<ColumnSpec>& specs, bool ofVertices, Workspace& space)
    : Specs(specs)
    , Written(Specs, ofVertices)
    , Kept(space, std::max(1, static_cast<int>(specs.size())), space.available() / 4)
  {
  }

  void keep(const std::vector<Column>& columns)
  {
    for (std::size_t i = 0; i < this->Specs.size(); ++i)
    {
      this->Kept.append(static_cast<int>(i), columns[i].bytes);
    }
  }

  /** Writes them as data of so many points or cells. */
  void write(TextOutput& out, std::int64_t tuples)
  {
    this->Kept.close();
    for (const std::size_t i : this->Written.order())
    {
      const ColumnSpec& spec = this->Specs[i];
      out << this->Written.linesBefore(i, tuples);
      dispatch(spec.type,
        [&]<class T>(T) { this->writeNumbers<T>(out, static_cast<int>(i), spec.components); });
    }
  }

  /** The numbers written that are NaN or infinite. */
  std::int64_t notFinite() const { return this->NotFinite; }

private:
  template <class T>
  void writeNumbers(TextOutput& out, int column, int components)
  {
    BucketFile::Reader reader(this->Kept, column);
    int component = 0;
    for (T number; reader.get(number);)
    {
      if constexpr (std::floating_point<T>)
      {
        this->NotFinite += std::isfinite(number) ? 0 : 1;
      }
      out << number << (++component < components ? ' ' : '\n');
      component %= components;
    }
  }

  const std::vector<ColumnSpec> Specs;
  const LegacyColumns Written;
  BucketFile Kept;
  std::int64_t NotFinite = 0;
};

/** Legacy VTK as text: what LegacyVtkWriter writes in binary. */
class TextVtkWriter : public MeshFileWriter
{
public:
  TextVtkWriter(const std::filesystem::path& path, const MeshFileInfo& info, Workspace& space)
    : Out(path)
    , Info(info)
    , PointData(info.vertexColumns, true, space)
    , CellData(info.elementColumns, false, space)
  {
    this->Out << "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET "
              << (this->isSurface() ? "POLYDATA\n" : "UNSTRUCTURED_GRID\n")
              << legacyGroups(info.groupTable, true) << "POINTS " << info.vertices << ' '
              << legacyTypeName(positionType(info.doublePositions)) << '\n';
  }

  void vertices(const VertexChunk& chunk) override
  {
    chunk.forEach(
      [this](std::span<const double, 3> position, std::size_t)
      {
        this->Out.position(position, this->Info.doublePositions);
        this->Out << '\n';
      });
    this->PointData.keep(chunk.columns);
  }

  void elements(const ElementChunk& chunk) override
  {
    if (chunk.first == 0)
    {
      this->Out << (this->isSurface() ? "POLYGONS " : "CELLS ") << this->Info.elements << ' '
                << this->Info.elements + this->Info.corners << '\n';
    }
    chunk.forEach(
      [this](std::span<const std::int64_t> corners, std::size_t)
      {
        this->Out << corners.size();
        this->Out.corners(corners, 0);
        this->Out << '\n';
      });
    this->CellData.keep(chunk.columns);
  }

  WriteNotes finish() override
  {
    if (!this->isSurface())
    {
      this->Out << "CELL_TYPES " << this->Info.elements << '\n';
      for (std::int64_t element = 0; element < this->Info.elements; ++element)
      {
        this->Out << std::int64_t(VtkCellTypes::Tetrahedron) << '\n';
      }
    }
    this->PointData.write(this->Out, this->Info.vertices);
    this->CellData.write(this->Out, this->Info.elements);
    this->Out.finish();
    return this->notes();
  }

private:
  bool isSurface() const { return this->Info.cellType == CellType::Triangle; }

  /** The reader of VTK stops at "nan" and "inf", and has wrong numbers from there on. */
  WriteNotes notes() const
  {
    const std::int64_t number = this->PointData.notFinite() + this->CellData.notFinite();
    if (number == 0)
    {
      return {};
    }
    return {
      counted(number, "number is", "numbers are") +
      " NaN or infinite: VTK and ParaView read neither from a text, nor what follows. Written as "
      "binary, which is the default, the file is read as it is."
    };
  }

  TextOutput Out;
  const MeshFileInfo Info;
  KeptColumns PointData, CellData;
};

double charactersOf(const std::vector<ColumnSpec>& columns)
{
  double characters = 0;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    characters += tupleCharacters(columns, static_cast<std::ptrdiff_t>(i));
  }
  return characters;
}

} // namespace

std::unique_ptr<MeshFileWriter> makeTextVtkWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* space)
{
  return std::make_unique<TextVtkWriter>(path, info, *space);
}

std::int64_t scratchOfTextVtk(const StreamInfo& mesh, std::int64_t, bool text)
{
  return text
           ? mesh.vertices * rowBytes(mesh.vertexColumns) + mesh.cells * rowBytes(mesh.cellColumns)
           : 0;
}

std::int64_t bytesOfTextVtk(const StreamInfo& mesh)
{
  constexpr double Type = 3; // "10" and the end of the line, of tetrahedra
  const double corners = 2 + cornersOf(mesh.cellType) * numberCharacters(mesh.vertices);
  return textBytes(mesh.vertices,
           positionCharacters(mesh.doublePositions) + charactersOf(mesh.vertexColumns)) +
         textBytes(mesh.cells, corners + charactersOf(mesh.cellColumns) +
                                 (mesh.cellType == CellType::Triangle ? 0 : Type));
}

} // namespace smg
