// SPDX-License-Identifier: BSD-3-Clause
#include "PieceFiles.h"

#include "ReadPart.h"

#include "IO/Files/FileNames.h"
#include "IO/Formats/Vtk/XmlTags.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Error.h"
#include "smg/MeshSource.h"
#include "smg/WriteMesh.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <iterator>
#include <sstream>
#include <string>
#include <system_error>
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

std::filesystem::path folderOf(const std::filesystem::path& out)
{
  return out.parent_path() / out.stem();
}

/** At least so many bytes does the mesh take in pieces, whose arrays are in base64. */
std::int64_t minBytes(const smg::StreamInfo& mesh)
{
  const auto bytesOf = [](const std::vector<smg::ColumnSpec>& columns)
  {
    std::int64_t bytes = 0;
    for (const smg::ColumnSpec& column : columns)
    {
      bytes += static_cast<std::int64_t>(smg::sizeOf(column.type)) * column.components;
    }
    return bytes;
  };
  constexpr std::int64_t OfStream = sizeof(std::int64_t) + 2; // GlobalIds and the marks
  const std::int64_t ofVertex =
    (mesh.doublePositions ? 24 : 12) + OfStream + bytesOf(mesh.vertexColumns);
  const std::int64_t ofCell = 8 * (cornersOf(mesh.cellType) + 1) + bytesOf(mesh.cellColumns);
  return (mesh.vertices * ofVertex + mesh.cells * ofCell) / 3 * 4;
}

/** Removes the index of an earlier result, so that what follows cannot be taken for that. */
void removeIndex(const std::filesystem::path& out)
{
  const std::filesystem::path index = smg::FileDescriptor::targetOf(out);
  std::error_code failure;
  const bool wasThere = std::filesystem::remove(index, failure);
  if (failure)
  {
    throw smg::Error(
      out.string() + ": the earlier result cannot be removed: " + failure.message() + '.');
  }
  if (wasThere)
  {
    smg::FileDescriptor::syncPath(index.parent_path(), out);
  }
}

/** Removes the pieces of an earlier result of more processes. */
void removePiecesFrom(const std::filesystem::path& out, int first)
{
  const std::filesystem::path folder = folderOf(out);
  std::vector<std::filesystem::path> others;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    const std::string name = entry.path().filename().string();
    const std::string begin = out.stem().string() + '_';
    const char* digits = name.c_str() + begin.size();
    int piece = -1;
    const bool isNumbered =
      name.starts_with(begin) &&
      std::from_chars(digits, name.c_str() + name.size(), piece).ec == std::errc();
    if (isNumbered && piece >= first && name == pieceName(out, piece))
    {
      others.push_back(entry.path());
    }
  }
  for (const std::filesystem::path& other : others)
  {
    smg::FileDescriptor::removeClosed(other);
  }
}

/** Writes the piece of this process; returns what it has. */
smg::StreamInfo writePiece(const smg::Team& team, const smg::VsmReader& mesh, PieceResult result,
  const std::filesystem::path& path)
{
  smg::VsmReader pieces(mesh.path(), nullptr, mesh.fingerprint());
  smg::MeshPiece piece;
  pieces.readPiece(firstCellOf(mesh.info(), team.rank(), team.size()),
    firstCellOf(mesh.info(), team.rank() + 1, team.size()), piece);
  ResultPiece source(mesh.info(), std::move(piece), std::move(result));
  smg::StreamInfo info = source.info();
  smg::writeMesh(source, path);
  return info;
}

} // namespace

void checkPieceFiles(const smg::StreamInfo& mesh, const std::filesystem::path& out)
{
  if (mesh.cellType == smg::CellType::Tetrahedron && smg::lowerSuffix(out) == ".pvtp")
  {
    throw smg::Error(out.string() + ": a .pvtp file holds no tetrahedra: choose .pvtu.");
  }
  const std::filesystem::path folder = folderOf(out);
  const bool isThere = std::filesystem::exists(folder);
  if (isThere && !std::filesystem::is_directory(folder))
  {
    throw smg::Error(out.string() + ": its pieces go into the folder " + folder.string() +
                     ", but that is a file: choose another name for the result.");
  }
  smg::FileDescriptor::createBeside(isThere ? folder / pieceName(out, 0) : out)
    .reserve(minBytes(mesh));
}

void writePieceFiles(
  smg::Team& team, smg::VsmReader& mesh, PieceResult result, const std::filesystem::path& out)
{
  const std::filesystem::path path = folderOf(out) / pieceName(out, team.rank());
  bool hasBegun = false;
  try
  {
    team.run(
      [&]
      {
        if (team.rank() == 0)
        {
          removeIndex(out);
          std::filesystem::create_directory(folderOf(out));
        }
        team.agree();
        hasBegun = true;
        const smg::StreamInfo described = writePiece(team, mesh, std::move(result), path);
        team.agree();
        if (team.rank() == 0)
        {
          removePiecesFrom(out, team.size());
          smg::writeFile(out, indexText(out, team.size(), described));
        }
      });
  }
  catch (const smg::Error&)
  {
    if (hasBegun)
    {
      smg::FileDescriptor::removeClosed(path);
    }
    throw;
  }
}
