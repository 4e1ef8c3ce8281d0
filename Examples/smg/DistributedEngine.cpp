// SPDX-License-Identifier: BSD-3-Clause
#include "DistributedEngine.h"

#include <dlfcn.h>

#ifdef SMG_HYPRE_ENGINE
const DistributedEngine& distributedEngine()
{
  // Found by the RUNPATH of the program. The components that OpenMPI loads look for its symbols
  // among the global ones.
  void* const handle = ::dlopen(SMG_HYPRE_ENGINE, RTLD_NOW | RTLD_GLOBAL);
  void* const symbol = handle ? ::dlsym(handle, "smgDistributedEngine") : nullptr;
  if (!symbol)
  {
    const char* const reason = ::dlerror();
    throw smg::Error(std::string("--engine hypre: the library ") + SMG_HYPRE_ENGINE +
                     " cannot be loaded (" + (reason ? reason : "unknown error") +
                     "): install it with MPI and hypre, or use --engine streaming.");
  }
  return *reinterpret_cast<decltype(&smgDistributedEngine)>(symbol)();
}
#else
const DistributedEngine& distributedEngine()
{
  throw smg::Error("--engine hypre: this smg was built without MPI and hypre (SMG_USE_HYPRE): use "
                   "--engine streaming.");
}
#endif
