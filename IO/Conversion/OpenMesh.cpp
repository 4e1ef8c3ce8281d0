// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Convert.h"

#include "IO/Arrays/ImportArrays.h"
#include "IO/Conversion/ConversionEstimate.h"
#include "IO/Conversion/ConversionStages.h"
#include "IO/Conversion/OpenArrays.h"
#include "IO/Formats/MeshFile.h"
#include "Solver/Files/ScratchAccount.h"
#include "Solver/Files/ScratchFolder.h"
#include "smg/Error.h"

#include <optional>
#include <utility>

namespace smg
{

struct OpenedMesh::Implementation
{
  std::optional<ScratchFolder> scratch;
  std::shared_ptr<FolderLock> lock; // of the folder of a checkpoint
  std::optional<ConversionReport> conversion;
  std::optional<VsmReader> reader;
};

OpenedMesh::OpenedMesh()
  : Self(std::make_unique<Implementation>())
{
}

OpenedMesh::~OpenedMesh() = default;

const StreamInfo& OpenedMesh::info() const
{
  return this->Self->reader->info();
}

std::unique_ptr<MeshSource> OpenedMesh::source(
  std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const
{
  return this->Self->reader->source(std::move(vertexColumns), std::move(cellColumns));
}

std::string OpenedMesh::fingerprint() const
{
  return this->Self->reader->fingerprint();
}

std::filesystem::path OpenedMesh::file() const
{
  return this->Self->reader->file();
}

VsmReader& OpenedMesh::reader()
{
  return *this->Self->reader;
}

const ConversionReport* OpenedMesh::conversion() const
{
  return this->Self->conversion ? &*this->Self->conversion : nullptr;
}

std::unique_ptr<OpenedMesh> openMesh(
  const std::filesystem::path& path, const ConversionOptions& options)
{
  std::unique_ptr<OpenedMesh> opened(new OpenedMesh);
  OpenedMesh::Implementation& mesh = *opened->Self;
  const MeshFileKind kind = kindOfInput(path);
  if (kind == MeshFileKind::Vsm)
  {
    if (options.weld || options.orient || options.cells != CellChoice::Only ||
        options.timeStep != 0 || options.partition)
    {
      throw Error(
        path.string() +
        ": a .vsm file is read as it is: leave the choice of cells, of a time step and of "
        "a partition, the merging of points and the turning of triangles to its conversion (smg "
        "convert).");
    }
    if (!options.checkpoint.empty())
    {
      requireNoConversionIn(options.checkpoint);
    }
    mesh.reader.emplace(path);
    mesh.reader->requireBlocksWithin(memoryOf(options));
    return opened;
  }
  ConversionOptions conversion = options;
  if (kind == MeshFileKind::Stream)
  {
    conversion.order = StreamOrder::Keep;
  }
  if (!options.checkpoint.empty())
  {
    CheckpointedConversion kept = convertInCheckpoint(path, conversion);
    mesh.lock = std::move(kept.lock);
    mesh.conversion = std::move(kept.report);
    mesh.reader.emplace(kept.mesh);
    return opened;
  }
  mesh.scratch.emplace(options.scratch, options.scratchLimit);
  conversion.scratch = mesh.scratch->path();
  const std::filesystem::path converted = mesh.scratch->path() / "mesh.vsm";
  mesh.conversion = convert(path, converted, conversion);
  mesh.conversion->scratch_bytes_peak = mesh.scratch->account().peak();
  mesh.reader.emplace(converted);
  return opened;
}

std::unique_ptr<OpenedMesh> openArrays(
  const ArrayView& points, const ArrayView& cells, const ConversionOptions& options)
{
  checkArrays(points, cells);
  std::unique_ptr<OpenedMesh> opened(new OpenedMesh);
  OpenedMesh::Implementation& mesh = *opened->Self;
  mesh.scratch.emplace(options.scratch, options.scratchLimit);
  ConversionOptions conversion = options;
  conversion.scratch = mesh.scratch->path();
  const std::filesystem::path name("the mesh"), converted = mesh.scratch->path() / "mesh.vsm";
  Conversion converting(name, converted, conversion,
    [&](Workspace& space, const ProgressFunction& progress)
    { return importArrays(points, cells, space, progress); });
  mesh.conversion = runConversion(converting);
  mesh.conversion->scratch_bytes_peak = mesh.scratch->account().peak();
  mesh.reader.emplace(converted);
  return opened;
}

ConversionReport convertArrays(const MeshArrays& mesh, const std::string& name,
  const std::filesystem::path& out, const ConversionOptions& options)
{
  checkOutputPlace(out);
  const std::filesystem::path in(name);
  Conversion converting(in, out, options,
    [&](Workspace& space, const ProgressFunction& progress)
    { return importArrays(mesh, name, options.cells, space, progress); });
  return runConversion(converting);
}

} // namespace smg
