// SPDX-License-Identifier: BSD-3-Clause
#include "PieceFiles.h"

#include "ReadPart.h"

#include "IO/Files/Suffix.h"
#include "IO/Formats/Vsm/ReservedNames.h"
#include "IO/Formats/Vtk/VtkXml.h"
#include "IO/Formats/Vtk/WriteVtkXml.h"
#include "Solver/Storage/WholeFile.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>

namespace
{

/** The piece of a process with its result, as a stream of one block. */
class ResultPiece final : public smg::MeshSource
{
public:
  ResultPiece(const smg::StreamInfo& mesh, smg::MeshPiece piece, PieceResult result)
    : Info(mesh)
  {
    this->Info.vertices = piece.vertices();
    const bool isMoved = !result.positions.empty();
    this->Info.bounds = isMoved ? decltype(mesh.bounds){} : mesh.bounds;
    this->Block.positions = std::move(isMoved ? result.positions : piece.positions);
    this->Block.corners = std::move(piece.corners);
    this->Info.cells =
      static_cast<std::int64_t>(this->Block.corners.size()) / cornersOf(mesh.cellType);
    PieceResult::add(result.vertexColumns, smg::GlobalIdsName, 1, piece.ids);
    PieceResult::add(result.vertexColumns, smg::GhostTypeName, 1, piece.ghost);
    PieceResult::add(result.vertexColumns, smg::StreamFinalizedName, 1, piece.finalized);
    this->Block.vertexColumns =
      joined(std::move(piece.vertexColumns), result.replaces, std::move(result.vertexColumns));
    this->Block.cellColumns =
      joined(std::move(piece.cellColumns), result.replaces, std::move(result.cellColumns));
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
  /** Columns of the mesh, except those that are replaced, then others. */
  static std::vector<smg::Column> joined(std::vector<smg::Column> columns,
    const std::function<bool(const smg::ColumnSpec&)>& replaces, std::vector<smg::Column> others)
  {
    std::erase_if(
      columns, [&replaces](const smg::Column& column) { return replaces(column.spec); });
    std::ranges::move(others, std::back_inserter(columns));
    return columns;
  }

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

void writePieceFiles(
  smg::Team& team, smg::VsmReader& mesh, PieceResult result, const std::filesystem::path& out)
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
      ResultPiece source(mesh.info(), std::move(piece), std::move(result));
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
