// SPDX-License-Identifier: BSD-3-Clause
#include "OnProcesses.h"

#include "Solver/Core/Text.h"

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

/** Ends what all processes have ended: the first one says why. The others end without an error, for
 * which mpiexec would end the first one, too, perhaps before it has said anything. */
void end(const smg::Team& team)
{
  if (team.rank() == 0)
  {
    throw;
  }
}

/** Runs work(team) on the processes. */
template <class Work>
void run(Work&& work)
{
  const Mpi mpi;
  smg::Team team(MPI_COMM_WORLD);
  try
  {
    work(team);
  }
  catch (const smg::TeamError&)
  {
    end(team);
  }
  catch (const smg::Cancelled&)
  {
    end(team);
  }
  catch (const std::exception& error)
  {
    if (team.size() == 1)
    {
      throw;
    }
    // The other processes do not know, and may be waiting for this one.
    std::fprintf(stderr, "smg: process %d of %d: %s\n", team.rank(), team.size(),
      smg::oneLine(error.what()).c_str());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
}

void solve(const DistributedJob& job, const DistributedSolve& task)
{
  run([&](smg::Team& team) { solveOn(team, job, task); });
}

void deform(const DistributedJob& job, const DistributedDeformation& task)
{
  run([&](smg::Team& team) { deformOn(team, job, task); });
}

} // namespace

extern "C" const DistributedEngine* smgDistributedEngine()
{
  static constexpr DistributedEngine engine{ solve, deform };
  return &engine;
}
