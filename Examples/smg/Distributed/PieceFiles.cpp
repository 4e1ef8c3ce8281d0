// SPDX-License-Identifier: BSD-3-Clause
#include "PieceFiles.h"

#include "ReadPart.h"

#include "IO/Files/Suffix.h"
#include "IO/Formats/Vsm/ReservedNames.h"
#include "IO/Formats/Vtk/VtkXml.h"
#include "IO/Formats/Vtk/WriteVtkXml.h"
#include "Solver/Storage/WholeFile.h"
#include "smg/SolvedMesh.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <sstream>
#include <string>
#include <utility>

namespace
{

template <class T>
void append(
  const char* name, int components, const std::vector<T>& values, std::vector<smg::Column>& columns)
{
  smg::Column column{ { name, smg::scalarTypeOf<T>(), components }, {} };
  column.bytes.resize(values.size() * sizeof(T));
  std::memcpy(column.bytes.data(), values.data(), column.bytes.size());
  columns.push_back(std::move(column));
}

/** The piece of a process with its solution, as a stream of one block. */
class SolvedPiece final : public smg::MeshSource
{
public:
  SolvedPiece(const smg::StreamInfo& mesh, smg::MeshPiece piece,
    const smg::DistributedSolution& solution, const smg::ResultOptions& results)
    : Info(mesh)
  {
    this->Info.vertices = piece.vertices();
    this->Block.positions = std::move(piece.positions);
    this->Block.corners = std::move(piece.corners);
    this->Info.cells =
      static_cast<std::int64_t>(this->Block.corners.size()) / cornersOf(mesh.cellType);
    this->Block.vertexColumns = std::move(piece.vertexColumns);
    this->Block.cellColumns = std::move(piece.cellColumns);
    for (auto* columns : { &this->Block.vertexColumns, &this->Block.cellColumns })
    {
      std::erase_if(*columns,
        [](const smg::Column& column)
        {
          return column.spec.name == smg::SolutionName || column.spec.name == smg::GradientName ||
                 column.spec.name == smg::FluxName;
        });
    }
    append(smg::SolutionName, solution.columns, solution.values, this->Block.vertexColumns);
    append(smg::GlobalIdsName, 1, piece.ids, this->Block.vertexColumns);
    append(smg::GhostTypeName, 1, piece.ghost, this->Block.vertexColumns);
    append(smg::StreamFinalizedName, 1, piece.finalized, this->Block.vertexColumns);
    if (results.gradient)
    {
      append(smg::GradientName, 3 * solution.columns, solution.gradient, this->Block.cellColumns);
    }
    if (results.flux)
    {
      append(smg::FluxName, 3 * solution.columns, solution.flux, this->Block.cellColumns);
    }
    this->Info.vertexColumns = specsOf(this->Block.vertexColumns);
    this->Info.cellColumns = specsOf(this->Block.cellColumns);
  }

  const smg::StreamInfo& info() const override { return this->Info; }
  bool next(smg::MeshBlock& block) override
  {
    if (std::exchange(this->Read, true))
    {
      return false;
    }
    block = std::move(this->Block);
    return true;
  }

private:
  static std::vector<smg::ColumnSpec> specsOf(const std::vector<smg::Column>& columns)
  {
    std::vector<smg::ColumnSpec> specs;
    for (const smg::Column& column : columns)
    {
      specs.push_back(column.spec);
    }
    return specs;
  }

  smg::StreamInfo Info;
  smg::MeshBlock Block;
  bool Read = false;
};

std::string pieceName(const std::filesystem::path& out, int piece)
{
  const char* suffix = smg::lowerSuffix(out) == ".pvtp" ? ".vtp" : ".vtu";
  return out.stem().string() + '_' + std::to_string(piece) + suffix;
}

void describe(std::ostream& text, const char* element, const std::vector<smg::ColumnSpec>& columns)
{
  text << "    <" << element << ">\n";
  for (const smg::ColumnSpec& column : columns)
  {
    text << "      <PDataArray type=\"" << smg::vtkXmlTypeName(column.type) << "\" Name=\""
         << smg::xmlEscaped(column.name) << "\" NumberOfComponents=\"" << column.components
         << "\"/>\n";
  }
  text << "    </" << element << ">\n";
}

std::string indexText(const std::filesystem::path& out, int pieces, const smg::StreamInfo& info)
{
  const std::string type = smg::lowerSuffix(out) == ".pvtp" ? "PPolyData" : "PUnstructuredGrid";
  std::ostringstream text;
  text << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type << "\" version=\"1.0\" byte_order=\""
       << (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")
       << "\" header_type=\"UInt64\">\n  <" << type << " GhostLevel=\"0\">\n";
  describe(text, "PPointData", info.vertexColumns);
  describe(text, "PCellData", info.cellColumns);
  describe(text, "PPoints",
    { { "Points", info.doublePositions ? smg::ScalarType::Float64 : smg::ScalarType::Float32,
      3 } });
  for (int piece = 0; piece < pieces; ++piece)
  {
    text << "    <Piece Source=\""
         << smg::xmlEscaped(out.stem().string() + '/' + pieceName(out, piece)) << "\"/>\n";
  }
  text << "  </" << type << ">\n</VTKFile>\n";
  return text.str();
}

} // namespace

void writePieceFiles(smg::Team& team, smg::VsmReader& mesh,
  const smg::DistributedSolution& solution, const smg::ResultOptions& results,
  const std::filesystem::path& out)
{
  const std::filesystem::path folder = out.parent_path() / out.stem();
  smg::StreamInfo described;
  team.run(
    [&]
    {
      if (team.rank() == 0)
      {
        std::filesystem::create_directories(folder);
      }
      team.agree();
      smg::VsmReader pieces(mesh.path());
      smg::MeshPiece piece;
      pieces.readPiece(firstCellOf(mesh.info(), team.rank(), team.size()),
        firstCellOf(mesh.info(), team.rank() + 1, team.size()), piece);
      SolvedPiece source(mesh.info(), std::move(piece), solution, results);
      described = source.info();
      smg::writeVtkXml(source, folder / pieceName(out, team.rank()));
    });
  // The index comes when all pieces are there.
  team.run(
    [&]
    {
      if (team.rank() == 0)
      {
        smg::writeFile(out, indexText(out, team.size(), described));
      }
    });
}
