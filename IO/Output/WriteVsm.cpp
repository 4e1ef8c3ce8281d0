// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Output/WriteVsm.h"


namespace smg
{

WrittenVsm writeVsm(MeshSource& source, const std::filesystem::path& path, Codec codec,
  const ProgressFunction& progress, const std::string& origin,
  const std::function<void(VsmWriter&)>& add)
{
  Progress reported(progress);
  VsmWriter writer(path, source.info(), codec);
  const auto cells = static_cast<double>(source.info().cells);
  const auto corners = static_cast<std::size_t>(cornersOf(source.info().cellType));
  for (MeshBlock block; source.next(block);)
  {
    writer.append(block);
    reported.update(
      (static_cast<double>(block.firstCell) + static_cast<double>(block.corners.size() / corners)) /
      cells);
  }
  if (add)
  {
    add(writer);
  }
  WrittenVsm written{ writer.finish(origin), 0.0 };
  written.meanWidth = writer.meanWidth();
  return written;
}

} // namespace smg
