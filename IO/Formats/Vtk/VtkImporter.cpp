// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/VtkImporter.h"

#include <atomic>

namespace smg
{

namespace
{

std::atomic<VtkImporter> TheVtkImporter{ nullptr };

} // namespace

void setVtkImporter(VtkImporter importer)
{
  TheVtkImporter = importer;
}

VtkImporter vtkImporter()
{
  return TheVtkImporter;
}

} // namespace smg
