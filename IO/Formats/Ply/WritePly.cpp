// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Ply/WritePly.h"

#include "IO/Files/InQuotes.h"
#include "IO/Files/PositionedFile.h"
#include "IO/Formats/Ply/PlyRecords.h"
#include "IO/Import/OtherCounts.h"
#include "Solver/Core/Progress.h"
#include "smg/Error.h"

#include <cstddef>
#include <limits>
#include <span>

namespace smg
{

namespace
{

/**
 * Writes the stream; all records of an element have the same size, so their positions are known.
 */
class PlyWriter
{
public:
  PlyWriter(const StreamInfo& info, const std::filesystem::path& path)
    : Info(info)
    , File(path)
    , Vertices("vertex", info.vertices)
    , Faces("face", info.cells)
  {
    this->Vertices.addPositions(info.doublePositions);
    this->Faces.add("list uchar int vertex_indices", 1 + 3 * sizeof(std::int32_t));
    this->Vertices.add(info.vertexColumns, this->Written);
    this->Faces.add(info.cellColumns, this->Written);
    const std::string header =
      plyFormatLines() + this->Vertices.header() + this->Faces.header() + "end_header\n";
    this->File.write(0, std::as_bytes(std::span(header)));
    this->VertexEnd = static_cast<std::int64_t>(header.size());
    this->FirstFace = this->FaceEnd =
      this->VertexEnd + info.vertices * static_cast<std::int64_t>(this->Vertices.recordBytes());
    this->File.reserve(
      this->FirstFace + info.cells * static_cast<std::int64_t>(this->Faces.recordBytes()));
  }

  void append(const MeshBlock& block)
  {
    this->Vertices.begin(static_cast<std::size_t>(block.vertices()));
    this->Vertices.fillPositions(block.positions);
    this->Vertices.fill(block.vertexColumns, this->Written);
    this->write(this->Vertices, this->VertexEnd);

    this->Corners.assign(block.corners.begin(), block.corners.end());
    this->Counts.assign(this->Corners.size() / 3, std::byte(3));
    this->Faces.begin(this->Counts.size());
    this->Faces.fill(0, this->Counts, 1);
    this->Faces.fill(1, std::as_bytes(std::span(this->Corners)), 3 * sizeof(std::int32_t));
    this->Faces.fill(block.cellColumns, this->Written);
    this->write(this->Faces, this->FaceEnd);
  }

  WrittenPly finish(const std::filesystem::path& path)
  {
    const std::int64_t end =
      this->FirstFace + this->Info.cells * static_cast<std::int64_t>(this->Faces.recordBytes());
    if (this->VertexEnd != this->FirstFace || this->FaceEnd != end)
    {
      throw Error(otherCounts(path.string(), this->Info));
    }
    this->File.finish();
    return this->Written;
  }

private:
  void write(const PlyRecords& records, std::int64_t& at)
  {
    this->File.write(at, records.records());
    at += static_cast<std::int64_t>(records.records().size());
  }

  const StreamInfo& Info;
  PositionedFile File;
  PlyRecords Vertices, Faces;
  std::int64_t VertexEnd = 0, FirstFace = 0, FaceEnd = 0;
  std::vector<std::int32_t> Corners;
  std::vector<std::byte> Counts; ///< of corners, each 3
  WrittenPly Written;
};

} // namespace

std::vector<std::string> notesOn(const WrittenPly& written)
{
  std::vector<std::string> notes;
  for (const auto& [column, name] : written.renamedColumns)
  {
    notes.push_back(
      "The column " + inQuotes(column) + " is called " + inQuotes(name) + " in the file.");
  }
  for (const std::string& name : written.roundedColumns)
  {
    notes.push_back("Values of the column " + inQuotes(name) +
                    " were rounded to double, since PLY has no 64-bit integers.");
  }
  return notes;
}

void checkPlyVertices(const std::filesystem::path& path, std::int64_t vertices)
{
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (vertices > most)
  {
    throw Error(path.string() + ": PLY has room for " + std::to_string(most) +
                " vertices, but there are " + std::to_string(vertices) + ": choose .vsm or .vtp.");
  }
}

WrittenPly writePly(
  MeshSource& source, const std::filesystem::path& path, const ProgressFunction& progress)
{
  const StreamInfo& info = source.info();
  checkPlyVertices(path, info.vertices);
  Progress reported(progress);
  PlyWriter writer(info, path);
  for (MeshBlock block; source.next(block);)
  {
    writer.append(block);
    const auto end =
      static_cast<double>(block.firstCell) + static_cast<double>(block.corners.size()) / 3.0;
    reported.update(end / static_cast<double>(info.cells));
  }
  return writer.finish(path);
}

} // namespace smg
