// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Restore/WriteRestored.h"

#include "IO/Container/VsmReader.h"
#include "IO/Formats/Suffix.h"
#include "IO/Restore/RestoredFormats.h"
#include "IO/Restore/RestoredMesh.h"
#include "Solver/Core/Error.h"

#include <algorithm>
#include <string_view>

namespace smg
{

namespace
{

/** A format, and whether it holds tetrahedra. */
struct Format
{
  std::string_view suffix;
  bool tetrahedra;
  RestoredNotes (*write)(RestoredMesh&, const std::filesystem::path&, Workspace&);
};

/** A writer that needs no workspace. */
template <RestoredNotes (*Write)(RestoredMesh&, const std::filesystem::path&)>
RestoredNotes alone(RestoredMesh& mesh, const std::filesystem::path& path, Workspace&)
{
  return Write(mesh, path);
}

constexpr Format Formats[] = {
  { ".ply", false, alone<writeRestoredPly> },
  { ".vtp", false, alone<writeRestoredVtkXml> },
  { ".vtu", true, alone<writeRestoredVtkXml> },
  { ".vtk", true, alone<writeRestoredVtk> },
  { ".obj", false, alone<writeRestoredObj> },
  { ".off", false, alone<writeRestoredOff> },
  { ".stl", false, writeRestoredStl },
  { ".mesh", true, alone<writeRestoredMedit> },
  { ".msh", true, alone<writeRestoredGmsh> },
  { ".node", true, alone<writeRestoredTetGen> },
  { ".ele", true, alone<writeRestoredTetGen> },
};

const Format* formatOf(const std::filesystem::path& path)
{
  const std::string suffix = lowerSuffix(path);
  const auto* const found = std::ranges::find(Formats, suffix, &Format::suffix);
  return found == std::end(Formats) ? nullptr : found;
}

} // namespace

void checkRestoredPath(const std::filesystem::path& path, CellType cellType)
{
  const Format* const format = formatOf(path);
  if (!format)
  {
    throw Error(path.string() +
                ": the original order can be restored in .ply, .vtp, .vtu, .vtk, .obj, .off, .stl, "
                ".mesh, .msh, .node and .ele files; a mesh stream has an order of its own.");
  }
  if (cellType == CellType::Tetrahedron && !format->tetrahedra)
  {
    throw Error(path.string() + ": the format holds no tetrahedra: choose .vtu, .vtk, .mesh, "
                                ".msh or .ele.");
  }
}

std::vector<std::string> writeRestored(
  const std::filesystem::path& vsm, const std::filesystem::path& out, Workspace& workspace)
{
  checkRestoredPath(out, VsmReader(vsm).info().cellType);
  const Format& format = *formatOf(out);
  RestoredMesh mesh(vsm, workspace);
  std::vector<std::string> notes = mesh.notes();
  const RestoredNotes more = format.write(mesh, out, workspace);
  notes.insert(notes.end(), more.begin(), more.end());
  workspace.tell(1.0);
  return notes;
}

} // namespace smg
