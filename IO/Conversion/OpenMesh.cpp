// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Conversion/OpenMesh.h"

#include "IO/AnyFormat/MeshFile.h"

namespace smg
{

std::unique_ptr<OpenedMesh> openMesh(
  const std::filesystem::path& path, const ConversionOptions& options)
{
  auto mesh = std::make_unique<OpenedMesh>();
  const MeshFileKind kind = kindOfInput(path);
  if (kind == MeshFileKind::Vsm)
  {
    mesh->Reader = std::make_unique<VsmReader>(path);
    return mesh;
  }
  ConversionOptions conversion = options;
  if (kind == MeshFileKind::Stream)
  {
    conversion.order = StreamOrder::Keep;
  }
  mesh->Scratch.emplace(options.scratch);
  const std::filesystem::path converted = mesh->Scratch->path() / "mesh.vsm";
  mesh->Conversion = convert(path, converted, conversion);
  mesh->Reader = std::make_unique<VsmReader>(converted);
  return mesh;
}

} // namespace smg
