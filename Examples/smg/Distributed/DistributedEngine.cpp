// SPDX-License-Identifier: BSD-3-Clause
#include "OnProcesses.h"

#include <mpi.h>

#include <cstdio>
#include <exception>

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

/** Ends what all processes have ended: the first one says why. */
int end(const smg::Team& team)
{
  if (team.rank() == 0)
  {
    throw;
  }
  return 1;
}

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
  catch (const smg::TeamError&)
  {
    return end(team);
  }
  catch (const smg::Cancelled&)
  {
    return end(team);
  }
  catch (const std::exception& error)
  {
    if (team.size() == 1)
    {
      throw;
    }
    // The other processes do not know, and may be waiting for this one.
    std::fprintf(stderr, "smg: process %d of %d: %s\n", team.rank(), team.size(), error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
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
