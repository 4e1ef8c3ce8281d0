// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Restore/RestoredFormats.h"
#include "IO/Restore/TextOutput.h"

namespace smg
{

RestoredNotes writeRestoredObj(RestoredMesh& mesh, const std::filesystem::path& path)
{
  TextOutput out(path);
  const bool isDouble = mesh.info().doublePositions;
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    const std::span<const double> positions = vertices.positions;
    for (std::size_t i = 0; i < positions.size(); i += 3)
    {
      out << "v ";
      out.position(positions.subspan(i, 3), isDouble);
      out << '\n';
    }
  }
  for (RestoredElements elements; mesh.next(elements);)
  {
    elements.forEach(
      [&out](std::span<const std::int64_t> corners)
      {
        out << 'f';
        for (const std::int64_t corner : corners)
        {
          out << ' ' << corner + 1;
        }
        out << '\n';
      });
  }
  out.finish();
  return {};
}

} // namespace smg
