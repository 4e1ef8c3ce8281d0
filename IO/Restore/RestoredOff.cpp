// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Restore/RestoredFormats.h"
#include "IO/Restore/TextOutput.h"

namespace smg
{

RestoredNotes writeRestoredOff(RestoredMesh& mesh, const std::filesystem::path& path)
{
  TextOutput out(path);
  const RestoredInfo& info = mesh.info();
  out << "OFF\n" << info.vertices << ' ' << info.elements << " 0\n";
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    const std::span<const double> positions = vertices.positions;
    for (std::size_t i = 0; i < positions.size(); i += 3)
    {
      out.position(positions.subspan(i, 3), info.doublePositions);
      out << '\n';
    }
  }
  for (RestoredElements elements; mesh.next(elements);)
  {
    elements.forEach(
      [&out](std::span<const std::int64_t> corners)
      {
        out << corners.size();
        for (const std::int64_t corner : corners)
        {
          out << ' ' << corner;
        }
        out << '\n';
      });
  }
  out.finish();
  return {};
}

} // namespace smg
