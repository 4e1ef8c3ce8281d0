// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/RestoredMesh.h"
#include "IO/Files/SequentialOutput.h"
#include "IO/Formats/Ply/PlyFormat.h"
#include "IO/Formats/Ply/PlyRecords.h"

#include <array>
#include <cstring>

namespace smg
{

namespace
{

/** Writes the vertices, then the faces, whose records have different sizes. */
class RestoredPlyWriter
{
public:
  RestoredPlyWriter(const RestoredInfo& info, const std::filesystem::path& path)
    : Info(info)
    , Out(path)
    , Vertices("vertex", info.vertices)
    , Faces("face", info.elements)
    , ManyCorners(info.mostCorners > UINT8_MAX)
  {
    this->Vertices.addPositions(info.doublePositions);
    // The list precedes each record and is not part of it.
    this->Faces.add(
      this->ManyCorners ? "list int int vertex_indices" : "list uchar int vertex_indices", 0);
  }

  WrittenPly write(RestoredMesh& mesh)
  {
    WrittenPly written;
    this->Vertices.add(this->Info.vertexColumns, written);
    this->Faces.add(this->Info.elementColumns, written);
    this->Out.put(
      plyFormatLines() + this->Vertices.header() + this->Faces.header() + "end_header\n");
    for (RestoredVertices vertices; mesh.next(vertices);)
    {
      this->Vertices.begin(static_cast<std::size_t>(vertices.count()));
      this->Vertices.fillPositions(vertices.positions);
      this->Vertices.fill(vertices.columns, written);
      this->Out.put(this->Vertices.records());
    }
    for (RestoredElements elements; mesh.next(elements);)
    {
      this->Faces.begin(elements.sizes.size());
      this->Faces.fill(elements.columns, written);
      this->writeFaces(elements);
    }
    this->Out.finish();
    return written;
  }

private:
  void writeFaces(const RestoredElements& elements)
  {
    this->Bytes.clear();
    elements.forEach(
      [&](std::span<const std::int64_t> corners, std::size_t face)
      {
        const auto count = static_cast<std::int32_t>(corners.size());
        this->ManyCorners ? this->add(&count, sizeof(count))
                          : this->add(std::array{ static_cast<std::uint8_t>(count) }.data(), 1);
        for (const std::int64_t corner : corners)
        {
          const auto number = static_cast<std::int32_t>(corner);
          this->add(&number, sizeof(number));
        }
        const std::size_t bytes = this->Faces.recordBytes();
        this->add(this->Faces.records().data() + bytes * face, bytes);
      });
    this->Out.put(this->Bytes);
  }

  void add(const void* bytes, std::size_t count)
  {
    const auto* const first = static_cast<const std::byte*>(bytes);
    this->Bytes.insert(this->Bytes.end(), first, first + count);
  }

  const RestoredInfo& Info;
  SequentialOutput Out;
  PlyRecords Vertices, Faces;
  const bool ManyCorners; ///< whether a face has more corners than a byte can count
  std::vector<std::byte> Bytes;
};

} // namespace

WriteNotes writeRestoredPly(RestoredMesh& mesh, const std::filesystem::path& path)
{
  checkPlyVertices(path, mesh.info().vertices);
  return notesOn(RestoredPlyWriter(mesh.info(), path).write(mesh));
}

} // namespace smg
