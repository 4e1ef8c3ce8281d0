// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingPoisson
 * @brief   Solves an elliptic problem on a very large mesh out of core
 *
 * Solves -div(K grad u - q) + s u = f by linear finite elements (or clamped or uniform Weights) on
 * a triangle or tetrahedral mesh by streaming multigrid. The input is a mesh in pieces, as
 * delivered by vtkStreamingMeshReader. The following define the problem together; later entries of
 * this list take precedence:
 * - Conductivity and Screening, numbers;
 * - arrays of the input, chosen by name with SetInputArrayToProcess() (see ArrayIndices);
 * - ProblemFileName and Problem, in the JSON of `smg solve --problem`, which can define all data;
 * - the conditions of upstream vtkMeshCondition filters.
 *
 * The number of right-hand sides is the number of components of the values. The output has the
 * point array `Solution` (ResultArrayName) and optionally the cell arrays `Gradient` and `Flux`,
 * and the point array `Gradient`. The report includes the flow through each condition
 * (docs/problem.md).
 *
 * vtkStreamingSolver describes how the input is requested, solved and delivered. If the input is
 * the preview of a surface and Solve says so, the filter solves on that preview in memory; this is
 * an approximation, as the report and GetOutcome() state. Streamed requests return the solution on
 * the mesh itself. All requests do if the preview lacks data that the problem needs (cell arrays,
 * or a point in a region), if there are boundary conditions (a preview has open edges that the mesh
 * does not have), and for solids, whose preview is their surface and has neither Gradient nor Flux.
 *
 * With several processes that have memory for the matrix, Engine solves on all of them together.
 *
 * @sa vtkMeshCondition vtkMultiEngineSolver vtkStreamingSolver vtkStreamingMeshReader
 * vtkStreamingMeshWriter
 */
#ifndef vtkStreamingPoisson_h
#define vtkStreamingPoisson_h

#include "vtkMultiEngineSolver.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingPoisson : public vtkMultiEngineSolver
{
public:
  static vtkStreamingPoisson* New();
  vtkTypeMacro(vtkStreamingPoisson, vtkMultiEngineSolver);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The indices of the input arrays, all of which are optional. */
  enum ArrayIndices
  {
    DIRICHLET_MASK = 0,     ///< points; not 0 where the value is prescribed
    DIRICHLET_VALUES = 1,   ///< points; the prescribed values; requires the mask
    SOURCE = 2,             ///< points or cells; f, a density
    INITIAL_GUESS = 3,      ///< points; the initial values of the iteration
    SCREENING_ARRAY = 4,    ///< points or cells; s, at least 0, instead of Screening
    CONDUCTIVITY_ARRAY = 5, ///< cells (points: the mean of the corners); K, 1, 3 or 6 components
    FIELD_ARRAY = 6         ///< cells; the vector q, 3 components or 3 per right-hand side
  };

  /** The accelerations of the V-cycles; see `smg solve --acceleration`. */
  enum AccelerationTypes
  {
    AUTOMATIC = 0,
    NONE = 1,
    CHEBYSHEV = 2,
    CONJUGATE_GRADIENTS = 3
  };

  /** The conductivity K, greater than 0, where nothing else defines it. Default: 1. */
  smgProperty(Conductivity, double);

  /** The screening s, at least 0: larger values keep the effect of sources local. Default: 0. */
  smgProperty(Screening, double);

  ///@{
  /** A problem in JSON, as for `smg solve --problem`: a file, and a string. Columns of the mesh are
   * arrays of the input. Default: none. */
  smgFileProperty(ProblemFileName);
  smgTextProperty(Problem);
  ///@}

  /** Whether the output has the cell array `Gradient`, grad u: 3 components per right-hand side.
   * Default: off. */
  smgFlagProperty(Gradient);

  /** Whether the output has the cell array `Flux`, -K grad u: 3 components per right-hand side.
   * Default: off. */
  smgFlagProperty(Flux);

  /** Whether the output has the point array `Gradient`: the mean of the gradients in the cells of a
   * point, weighted by area or volume. Default: off. */
  smgFlagProperty(GradientAtPoints);

  /** Groups of cells, by names, numbers or patterns with `*`, over which the report has integrals
   * of the solution, of its gradient and of its flux; "*" is the whole and all of them. Default:
   * none.
   */
  smgNamesProperty(Integral);

  /** The acceleration of the V-cycles. Default: AUTOMATIC. */
  smgOption(Acceleration, int);

  /** Whether the solver works in memory, without files. Default: off. The solution does not depend
   * on it. */
  smgFlagProperty(InCore);

  /** Name of the point array with the solution. Default: "Solution". */
  smgTextProperty(ResultArrayName);

  /** V-cycles of the last solve. */
  int GetCycles();

  /** Includes the change of the problem file that the last update of the pipeline has found. */
  vtkMTimeType GetMTime() override;

protected:
  vtkStreamingPoisson();
  ~vtkStreamingPoisson() override;

  void CheckRanges() const override;
  /** Names Mesh Conditions instead of the entries of the problem that they make. */
  std::string InPanelWords(const std::string& text) override;
  /** Looks whether the problem file has changed, once for every update of the pipeline. */
  int ComputePipelineMTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector, int port, vtkMTimeType* time) override;

  std::unique_ptr<smg::JobTask> MakeTask(vtkPointSet& input) override;
  std::unique_ptr<smg::JobTask> MakeEstimatedTask(vtkPointSet& input) override;
  bool IsForMemory(vtkPointSet& input, bool isWhole) override;
  smg::SolveSummary SolveInProcesses(vtkPointSet& piece,
    const std::function<bool(double)>& progress, std::vector<double>& values) override;
  std::string WhyStreaming() override;
  void Deliver(vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output) override;

private:
  vtkStreamingPoisson(const vtkStreamingPoisson&) = delete;
  void operator=(const vtkStreamingPoisson&) = delete;

  struct Internals;

  double Conductivity = 1.0;
  double Screening = 0.0;
  std::string ProblemFileName;
  std::string Problem;
  bool Gradient = false;
  bool Flux = false;
  bool GradientAtPoints = false;
  std::vector<std::string> Integrals;
  bool InCore = false;
  std::string ResultArrayName = "Solution";

  std::unique_ptr<Internals> Internal;
};

#endif
