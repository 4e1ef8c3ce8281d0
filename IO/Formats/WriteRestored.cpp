// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/WriteRestored.h"

#include "IO/Export/RestoredMesh.h"
#include "IO/Formats/FormatTable.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

namespace smg
{

void checkRestoredPath(const std::filesystem::path& path, CellType cellType)
{
  const FileSuffix* const suffix = suffixFor(FormatUse::Restore, path);
  if (!suffix)
  {
    throw Error(path.string() + ": the original order can be restored in " +
                suffixList(FormatUse::Restore, "and") +
                " files; a mesh stream has an order of its own.");
  }
  checkHolds(path, *suffix, cellType, suffixList(FormatUse::Restore, cellType, "or"));
}

std::vector<std::string> writeRestored(
  const std::filesystem::path& vsm, const std::filesystem::path& out, Workspace& workspace)
{
  checkRestoredPath(out, VsmReader(vsm).info().cellType);
  RestoredMesh mesh(vsm, workspace);
  std::vector<std::string> notes = mesh.notes();
  const WriteNotes more = formatOfName(out)->restore(mesh, out);
  notes.insert(notes.end(), more.begin(), more.end());
  workspace.tell(1.0);
  return notes;
}

} // namespace smg
