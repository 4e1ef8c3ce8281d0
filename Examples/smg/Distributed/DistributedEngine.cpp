// SPDX-License-Identifier: BSD-3-Clause
#include "OnProcesses.h"

#include <mpi.h>

namespace
{

/** MPI, from construction to destruction. */
class Mpi
{
public:
  Mpi()
  {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  }
  ~Mpi() { MPI_Finalize(); }
  Mpi(const Mpi&) = delete;
  Mpi& operator=(const Mpi&) = delete;
};

/** Runs work(team) on the processes. */
template <class Work>
int run(Work&& work)
{
  const Mpi mpi;
  smg::Team team(MPI_COMM_WORLD);
  try
  {
    work(team);
    return 0;
  }
  catch (const smg::Error&)
  {
    // The first process says it for all.
    if (team.rank() == 0)
    {
      throw;
    }
    return 1;
  }
}

int solve(const DistributedJob& job, const DistributedSolve& task)
{
  return run([&](smg::Team& team) { solveOn(team, job, task); });
}

int deform(const DistributedJob& job, const DistributedDeformation& task)
{
  return run([&](smg::Team& team) { deformOn(team, job, task); });
}

} // namespace

extern "C" const DistributedEngine* smgDistributedEngine()
{
  static constexpr DistributedEngine engine{ solve, deform };
  return &engine;
}
