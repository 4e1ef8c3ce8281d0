// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Gmsh/GmshFormat.h"

#include "IO/Files/TextStart.h"

namespace smg
{

namespace
{

bool isGmsh(std::string_view start)
{
  return textStart(start).starts_with("$MeshFormat");
}

constexpr FileSuffix GmshSuffixes[] = { { ".msh", true, true, true } };

} // namespace

const Format GmshFormat{
  .name = "Gmsh",
  .suffixes = GmshSuffixes,
  .attributes = "tags of cells",
  .hasSign = isGmsh,
  .parse = parseWith<importGmsh>,
  .share = { 250, 4 },
  .bytes = bytesOfGmsh,
  .restore = writeRestoredGmsh,
};

} // namespace smg
