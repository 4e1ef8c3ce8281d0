// SPDX-License-Identifier: BSD-3-Clause
#include "VtkBridge.h"

#include "IO/Import/Importer.h"
#include "Solver/Core/Error.h"

#include <string>

#include <dlfcn.h>

void loadVtkFor(const std::filesystem::path& path)
{
  const smg::MeshFormat format = smg::meshFormat(path);
  if (format != smg::MeshFormat::VtkLegacy && format != smg::MeshFormat::VtkXml)
  {
    return;
  }
  // Found by the program's RUNPATH. Never unloaded: VTK's singletons do not survive that.
  void* library = ::dlopen(SMG_VTK_BRIDGE, RTLD_NOW | RTLD_GLOBAL);
  if (!library)
  {
    throw smg::Error(path.string() + ": the library that reads VTK files cannot be loaded (" +
                     std::string(::dlerror()) + "): convert the file to PLY or .mesh.");
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
}
