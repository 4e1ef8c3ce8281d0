// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingPoisson
 * @brief   Solves an elliptic problem on a gigantic mesh out of core
 *
 * Solves -div(K grad u - q) + s u = f by linear finite elements (or clamped or uniform Weights) on
 * a triangle or tetrahedral mesh and streaming multigrid. The input is a mesh in pieces, as
 * vtkStreamingMeshReader delivers it. The problem is what these say together; where they say
 * something of the same place, what stands later in this list counts:
 * - Conductivity and Screening, numbers;
 * - arrays of the input, chosen by name with SetInputArrayToProcess() (see ArrayIndices);
 * - ProblemFileName and Problem, in the words of `smg solve --problem`, which can say everything;
 * - the conditions that vtkMeshCondition filters before this one have added.
 *
 * The number of right-hand sides is that of the components of the values. The output has the point
 * array `Solution` (ResultArrayName) and, if wanted, the cell arrays `Gradient` and `Flux`. The
 * report also says what flows through each condition (docs/problem.md).
 *
 * vtkStreamingSolver describes how it pulls, solves and answers. A request for the whole mesh of a
 * reader that answers with the preview of a surface is answered by a solve on that preview, in
 * memory and at once; that is an approximation, and the report says so. Streamed requests get the
 * solution on the mesh itself, and so do all with SolveFullMesh: then the preview has the true
 * solution at its points. So it has where it lacks what the problem needs, arrays of the cells or a
 * point in a region, where there are conditions of the boundary, since a preview has open edges
 * that the mesh has not, and where the mesh is a solid, whose preview is its surface; that has
 * neither Gradient nor Flux.
 *
 * @sa vtkMeshCondition vtkStreamingSolver vtkStreamingMeshReader vtkStreamingMeshWriter
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

  /** The indices of the input arrays; none has to be chosen. */
  enum ArrayIndices
  {
    DIRICHLET_MASK = 0,     ///< points; not 0 where the value is prescribed
    DIRICHLET_VALUES = 1,   ///< points; these values; goes with the mask
    SOURCE = 2,             ///< points or cells; f, a density
    INITIAL_GUESS = 3,      ///< points; where the iteration begins, without it at 0
    SCREENING_ARRAY = 4,    ///< points or cells; s, at least 0, instead of Screening
    CONDUCTIVITY_ARRAY = 5, ///< cells (of points: the mean of the corners); K, 1, 3 or 6 components
    FIELD_ARRAY = 6         ///< cells; the vector q, 3 components or 3 a right-hand side
  };

  /** How V-cycles are made to converge faster; see `smg solve --acceleration`. */
  enum AccelerationTypes
  {
    AUTOMATIC = 0,
    NONE = 1,
    CHEBYSHEV = 2,
    CONJUGATE_GRADIENTS = 3
  };

  ///@{
  /** The conductivity K, greater than 0, where nothing else says it. Default: 1. */
  vtkSetMacro(Conductivity, double);
  vtkGetMacro(Conductivity, double);
  ///@}

  ///@{
  /** The screening s, at least 0: larger values keep the effect of sources local. Default: 0. */
  vtkSetMacro(Screening, double);
  vtkGetMacro(Screening, double);
  ///@}

  ///@{
  /**
   * A problem in JSON, as `smg solve --problem` reads it: a file, and a text. Columns of the mesh
   * are arrays of the input. Default: none.
   */
  vtkSetFilePathMacro(ProblemFileName);
  vtkGetFilePathMacro(ProblemFileName);
  vtkSetStringMacro(Problem);
  vtkGetStringMacro(Problem);
  ///@}

  ///@{
  /** Whether the output has the cell array `Gradient`, grad u: 3 components a right-hand side.
   * Default: off. */
  vtkSetMacro(Gradient, bool);
  vtkGetMacro(Gradient, bool);
  vtkBooleanMacro(Gradient, bool);
  ///@}

  ///@{
  /** Whether the output has the cell array `Flux`, -K grad u: 3 components a right-hand side.
   * Default: off. */
  vtkSetMacro(Flux, bool);
  vtkGetMacro(Flux, bool);
  vtkBooleanMacro(Flux, bool);
  ///@}

  ///@{
  /** How V-cycles are made to converge faster. Default: AUTOMATIC. */
  vtkSetClampMacro(Acceleration, int, AUTOMATIC, CONJUGATE_GRADIENTS);
  vtkGetMacro(Acceleration, int);
  ///@}

  ///@{
  /** Whether the solver works in memory, without files. Default: off. The solution is the same. */
  vtkSetMacro(InCore, bool);
  vtkGetMacro(InCore, bool);
  vtkBooleanMacro(InCore, bool);
  ///@}

  ///@{
  /** Whether the full mesh is solved on even where only the preview of a surface is asked for.
   * Default: off. */
  vtkSetMacro(SolveFullMesh, bool);
  vtkGetMacro(SolveFullMesh, bool);
  vtkBooleanMacro(SolveFullMesh, bool);
  ///@}

  ///@{
  /** Name of the point array with the solution. Default: "Solution". */
  vtkSetStringMacro(ResultArrayName);
  vtkGetStringMacro(ResultArrayName);
  ///@}

  /** V-cycles of the last solve. */
  int GetCycles();

  /** A change of the problem file is one of the filter. */
  vtkMTimeType GetMTime() override;

protected:
  vtkStreamingPoisson();
  ~vtkStreamingPoisson() override;

  std::unique_ptr<smg::StreamedTask> MakeTask(vtkPointSet& input) override;
  bool IsForMemory(vtkPointSet& input, bool isWhole) override;
  smg::SolveSummary SolveInMemory(vtkPointSet& input, const std::function<bool(double)>& progress,
    std::vector<double>& values) override;
  void Deliver(vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output) override;

private:
  vtkStreamingPoisson(const vtkStreamingPoisson&) = delete;
  void operator=(const vtkStreamingPoisson&) = delete;

  struct Internals;

  double Conductivity = 1.0;
  double Screening = 0.0;
  char* ProblemFileName = nullptr;
  char* Problem = nullptr;
  bool Gradient = false;
  bool Flux = false;
  int Acceleration = AUTOMATIC;
  bool InCore = false;
  bool SolveFullMesh = false;
  char* ResultArrayName = nullptr;

  std::unique_ptr<Internals> Internal;
};

#endif
