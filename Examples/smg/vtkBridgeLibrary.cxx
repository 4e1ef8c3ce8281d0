// SPDX-License-Identifier: BSD-3-Clause
// The library that the program smg loads when it is to read a VTK file.
#include "IO/Formats/Vtk/ImportInChild.h"
#include "IO/vtkMeshImport.h"

#include <vtkLogger.h>

extern "C" __attribute__((visibility("default"))) void smgRegisterVtkImporter()
{
  // What VTK complains of comes as an exception; the program says it in a line of its own.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  smg::setVtkImporter([](const std::filesystem::path& path, smg::VtkXmlKind kind,
                        smg::RawMeshBuilder& builder, const smg::ProgressFunction& progress)
    { smg::importInChild(smg::recodeVtkFile, path, kind, builder, progress); });
}
