// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingPoisson
 * @brief   Solves a Poisson problem on a gigantic mesh out of core
 *
 * Solves -div grad u + s u = f with u prescribed at constrained points, by linear finite elements
 * (or clamped or uniform Weights) on a triangle or tetrahedral mesh and streaming multigrid; s is
 * the Screening, f the source, both lumped at the points. The input is a mesh in pieces, as
 * vtkStreamingMeshReader delivers it; arrays are chosen by name with SetInputArrayToProcess()
 * (point arrays; the number of components of the values is the number of right-hand sides):
 * - 0: Dirichlet mask, not 0 where a point is constrained;
 * - 1: Dirichlet values, used at constrained points;
 * - 2: source (optional), a density;
 * - 3: initial guess (optional, else 0), used at free points.
 *
 * How it pulls, solves and answers is told at vtkStreamingSolver. A request for the whole mesh of a
 * reader that answers with a preview gets the preview with the true solution at its points.
 *
 * @sa vtkStreamingSolver vtkStreamingMeshReader vtkStreamingMeshWriter
 */
#ifndef vtkStreamingPoisson_h
#define vtkStreamingPoisson_h

#include "vtkStreamingMultigridFiltersModule.h" // For export macro
#include "vtkStreamingSolver.h"

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingPoisson : public vtkStreamingSolver
{
public:
  static vtkStreamingPoisson* New();
  vtkTypeMacro(vtkStreamingPoisson, vtkStreamingSolver);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The screening s, at least 0: larger values keep the effect of sources local. Default: 0. */
  vtkSetClampMacro(Screening, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Screening, double);
  ///@}

  ///@{
  /** Whether the solver works in memory, without files. Default: off. The solution is the same. */
  vtkSetMacro(InCore, bool);
  vtkGetMacro(InCore, bool);
  vtkBooleanMacro(InCore, bool);
  ///@}

  ///@{
  /** Name of the point array with the solution. Default: "Solution". */
  vtkSetStringMacro(ResultArrayName);
  vtkGetStringMacro(ResultArrayName);
  ///@}

  /** V-cycles of the last solve. */
  int GetCycles();

protected:
  vtkStreamingPoisson();
  ~vtkStreamingPoisson() override;

  std::unique_ptr<smg::StreamedTask> MakeTask(vtkPointSet& input) override;
  void Deliver(vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output) override;

private:
  vtkStreamingPoisson(const vtkStreamingPoisson&) = delete;
  void operator=(const vtkStreamingPoisson&) = delete;

  double Screening = 0.0;
  bool InCore = false;
  char* ResultArrayName = nullptr;
};

#endif
