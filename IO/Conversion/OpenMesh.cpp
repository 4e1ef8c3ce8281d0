// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Convert.h"

#include "IO/AnyFormat/MeshFile.h"
#include "IO/Formats/MeshPart.h"
#include "Solver/Storage/ScratchFolder.h"

#include <optional>

namespace smg
{

struct OpenedMesh::Implementation
{
  std::optional<ScratchFolder> scratch;
  std::optional<ConversionReport> conversion;
  std::optional<VsmReader> reader;
};

OpenedMesh::OpenedMesh()
  : Self(std::make_unique<Implementation>())
{
}

OpenedMesh::~OpenedMesh() = default;

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
    checkIsWhole({ options.timeStep, options.partition }, path.string());
    mesh.reader.emplace(path);
    return opened;
  }
  ConversionOptions conversion = options;
  if (kind == MeshFileKind::Stream)
  {
    conversion.order = StreamOrder::Keep;
  }
  mesh.scratch.emplace(options.scratch);
  const std::filesystem::path converted = mesh.scratch->path() / "mesh.vsm";
  mesh.conversion = convert(path, converted, conversion);
  mesh.reader.emplace(converted);
  return opened;
}

} // namespace smg
