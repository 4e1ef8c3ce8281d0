// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkAttributes.h"

#include "IO/Files/FileNames.h"

namespace smg
{
namespace
{

std::string quotedList(const std::set<std::string>& all)
{
  std::string names;
  for (const std::string& name : all)
  {
    names += (names.empty() ? "" : ", ") + inQuotes(name);
  }
  return names;
}

} // namespace

void noteArrays(RawMeshBuilder& builder, const std::set<std::string>& others,
  const std::set<std::string>& repeated)
{
  if (!others.empty())
  {
    builder.note("Arrays of texts or bits are left out: " + quotedList(others) + ".");
  }
  if (!repeated.empty())
  {
    builder.note("Of several arrays of one name, the second one and others have numbers after "
                 "their names, as NAME_1: " +
                 quotedList(repeated) + ".");
  }
}

void noteFields(RawMeshBuilder& builder, const std::set<std::string>& names)
{
  if (!names.empty())
  {
    builder.note(
      "Field data are left out, since a mesh has no place for them: " + quotedList(names) + '.');
  }
}

void noteGhosts(RawMeshBuilder& builder, std::int64_t ghosts)
{
  if (ghosts > 0)
  {
    builder.note("Cells that the array vtkGhostType marks as ghosts or as hidden are left out: " +
                 std::to_string(ghosts) + '.');
  }
}

} // namespace smg
