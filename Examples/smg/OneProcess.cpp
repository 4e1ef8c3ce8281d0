// SPDX-License-Identifier: BSD-3-Clause
#include "OneProcess.h"

#include "smg/Error.h"

#include <cstdlib>
#include <string>

void requireOneProcess()
{
  // Of Open MPI, and of MPICH and Slurm.
  for (const char* name : { "OMPI_COMM_WORLD_SIZE", "PMI_SIZE" })
  {
    const char* size = std::getenv(name);
    if (size && std::atoi(size) > 1)
    {
      throw smg::Error(std::string(size) +
                       " processes were started, which would all do the same and "
                       "write the same files: start smg once, or solve or deform with them "
                       "together (--engine hypre).");
    }
  }
}
