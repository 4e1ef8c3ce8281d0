// SPDX-License-Identifier: BSD-3-Clause
#include "VtkBridge.h"

#include "IO/AnyFormat/FormatTable.h"
#include "IO/Formats/Vtk/VtkFormats.h"
#include "IO/Formats/Vtk/VtkImporter.h"
#include "Solver/Core/Error.h"

#include <string>

#include <dlfcn.h>

namespace
{

/** Loads the library, which sets an importer in this one's place, and lets that import. */
void importWithLibrary(const std::filesystem::path& path, smg::VtkXmlKind kind,
  smg::RawMeshBuilder& builder, const smg::ProgressFunction& progress)
{
  // Found by the program's RUNPATH. Never unloaded: VTK's singletons do not survive that.
  void* library = ::dlopen(SMG_VTK_BRIDGE, RTLD_NOW | RTLD_GLOBAL);
  if (!library)
  {
    throw smg::Error(path.string() + ": the library that reads compressed VTK files cannot be " +
                     "loaded (" + std::string(::dlerror()) +
                     "): save the file without compression.");
  }
  using Function = void (*)();
  const auto registerImporter =
    reinterpret_cast<Function>(::dlsym(library, "smgRegisterVtkImporter"));
  if (!registerImporter)
  {
    throw smg::Error(
      path.string() + ": the library " SMG_VTK_BRIDGE " does not belong to this program.");
  }
  registerImporter();
  smg::vtkImporter()(path, kind, builder, progress);
}

} // namespace

void loadVtkFor(const std::filesystem::path& path)
{
  const smg::Format* const format = smg::formatOfFile(path);
  if (format == &smg::VtkXmlFormat || format == &smg::ParallelVtkXmlFormat)
  {
    smg::setVtkImporter(importWithLibrary);
  }
}
