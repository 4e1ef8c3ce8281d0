// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMultiEngineSolver
 * @brief   Base class of filters that solve out of core or on several processes
 *
 * Engine chooses what solves: process 0, which streams, or all processes together, in memory.
 *
 * @sa vtkStreamingSolver vtkStreamingPoisson vtkStreamingMeshDeformation
 */
#ifndef vtkMultiEngineSolver_h
#define vtkMultiEngineSolver_h

#include "vtkStreamingMultigridFiltersModule.h" // For export macro
#include "vtkStreamingSolver.h"

#include <string> // For std::string

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkMultiEngineSolver : public vtkStreamingSolver
{
public:
  vtkTypeMacro(vtkMultiEngineSolver, vtkStreamingSolver);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** What solves: see SetEngine(). */
  enum EngineTypes
  {
    STREAMING = 0,
    DISTRIBUTED = 1,
    AUTOMATIC_ENGINE = 2
  };

  /**
   * What solves. Default: STREAMING.
   * - STREAMING: process 0, out of core, in little memory.
   * - DISTRIBUTED: all processes of the controller together, in memory, by conjugate gradients with
   *   hypre's BoomerAMG (see smg/DistributedSolver.h). Each solves for the points of the piece that
   *   it has; no process needs the whole solution. Needs MPI, and a build with hypre. The input may
   *   be any mesh in pieces whose points have GlobalIds, equal where points are the same vertex;
   *   a cell that several processes have must be marked as a duplicate in vtkGhostType in all but
   *   one, points of no cell and previews are refused. A cycle is an iteration, of which
   *   MaximumCycles limits those for each right-hand side; Sweeps, Operators, Acceleration,
   *   NumberOfPieces, NumberOfThreads and MemoryLimit have no effect. Streamed requests, which
   *   process 0 answers alone, are solved for by STREAMING.
   * - AUTOMATIC_ENGINE: DISTRIBUTED where there is more than one process and their memory holds an
   *   estimate of what it needs, else STREAMING; a note says why.
   */
  smgProperty(Engine, int);

protected:
  using vtkStreamingSolver::vtkStreamingSolver;
  ~vtkMultiEngineSolver() override = default;

  void CheckRanges() const override;
  bool IsForProcesses(vtkPointSet& piece, bool isAlone) override;

  /** Why AUTOMATIC_ENGINE is STREAMING, whatever the memory: because of checkpoints. Empty: nothing
   * says so. */
  virtual std::string WhyStreaming();

  /** Right-hand sides by which AUTOMATIC_ENGINE estimates the memory. Default: 3, as many as a
   * position or a displacement has. */
  virtual int GetUsualColumns() { return 3; }

  /** For the notes of the next solve: why the engine is not the one that was asked for, or which
   * one was chosen; empty: nothing to say. */
  const std::string& GetEngineNote() const { return this->EngineNote; }

  int Engine = STREAMING;

private:
  vtkMultiEngineSolver(const vtkMultiEngineSolver&) = delete;
  void operator=(const vtkMultiEngineSolver&) = delete;

  std::string EngineNote;
};

#endif
