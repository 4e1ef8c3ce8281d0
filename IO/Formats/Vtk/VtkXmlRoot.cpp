// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkXmlRoot.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace smg
{

namespace
{

/** A file that is cut off within its last tags may look whole otherwise. */
void requireEnd(InputFile& file)
{
  constexpr std::size_t Most = 4096;
  const std::size_t begin = file.size() - std::min(file.size(), Most);
  if (file.at(begin, Most).find("</VTKFile") == std::string_view::npos)
  {
    file.fail(file.size(), "the file does not end with </VTKFile>: it is truncated");
  }
}

} // namespace

XmlTag vtkXmlRoot(InputFile& file, XmlTags& tags)
{
  requireEnd(file);
  XmlTag root;
  if (!tags.next(root) || root.name != "VTKFile")
  {
    file.fail(0, "the file does not begin with <VTKFile>");
  }
  return root;
}

} // namespace smg
