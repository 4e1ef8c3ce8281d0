// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/VtkHdf/VtkHdfFormat.h"

#include "IO/Mesh/Columns.h"
#include "smg/Error.h"

#include <algorithm>
#include <dlfcn.h>

namespace smg
{

namespace
{

/**
 * Loads the library permanently. Throws Error if it, or a library that it needs, does not exist.
 */
const VtkHdfLibrary& library()
{
  static const VtkHdfLibrary* const loaded = []
  {
    // Found by the RUNPATH of this library.
    void* const handle = ::dlopen(SMG_VTKHDF_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    void* const symbol = handle ? ::dlsym(handle, "smgVtkHdfLibrary") : nullptr;
    if (!symbol)
    {
      const char* const reason = ::dlerror();
      throw Error("VTKHDF files cannot be read or written, since the library " +
                  std::string(SMG_VTKHDF_LIBRARY) + " cannot be loaded (" +
                  (reason ? reason : "unknown error") + ").");
    }
    return reinterpret_cast<decltype(&smgVtkHdfLibrary)>(symbol)();
  }();
  return *loaded;
}

/** The signature is at the beginning, or after a user block of 512, 1024 ... bytes. */
bool isHdf5(std::string_view start)
{
  constexpr std::string_view Signature = "\x89HDF\r\n\x1a\n";
  constexpr std::size_t MinBlock = 512;
  bool found = start.starts_with(Signature);
  for (std::size_t block = MinBlock; !found && block < start.size(); block *= 2)
  {
    found = start.substr(block).starts_with(Signature);
  }
  return found;
}

void parse(InputFile& file, RawMeshBuilder& builder, const MeshPart& part, const ProgressFunction&)
{
  library().import(file, builder, part);
}

std::optional<FileCounts> counts(InputFile& file, const MeshPart& part)
{
  return library().counts(file, part);
}

std::vector<double> times(const std::filesystem::path& path)
{
  return library().times(path);
}

WriteNotes write(const std::filesystem::path& vsm, const std::filesystem::path& path,
  const WriteMeshOptions& options)
{
  return library().write(vsm, path, options.progress);
}

std::int64_t bytesOfVtkHdf(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  // Every partition begins with the points that are alive.
  const std::int64_t ghosts =
    mesh.cells / VtkHdfPartitionCells * std::max<std::int64_t>(mesh.width, 0);
  constexpr std::int64_t IdBytes = 8, FlagBytes = 1;
  return (mesh.vertices + ghosts) *
           rowBytes(mesh.vertexColumns, positionBytes(mesh) + IdBytes + FlagBytes) +
         mesh.cells *
           rowBytes(mesh.cellColumns, (cornersOf(mesh.cellType) + 1) * IdBytes + FlagBytes);
}

constexpr FileSuffix VtkHdfSuffixes[] = { { ".vtkhdf" }, { ".hdf" } };

} // namespace

/** Partitions whose points have global numbers become one mesh, without duplicate cells. Writes
 * version 1.0, which every reader since VTK 9.1 supports. */
const Format VtkHdfFormat{
  .name = "VTKHDF",
  .suffixes = VtkHdfSuffixes,
  .description = "versions 1 and 2 (HDF5); one of any number of time steps; all partitions or one; "
                 "written as unstructured grid",
  .cells = "polygonal data, unstructured grids",
  .holdsColumns = true,
  .groups = GroupForm::Columns,
  .hasMagic = isHdf5,
  .parse = parse,
  .counts = counts,
  .hasParts = true,
  .times = times,
  .bytes = bytesOfVtkHdf,
  .writeVsm = write,
};

} // namespace smg
