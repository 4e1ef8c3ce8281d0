// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingPoisson
 * @brief   Solves a Poisson problem on a gigantic mesh out of core
 *
 * Solves (L + s M) x = M f with x prescribed at constrained points, by streaming multigrid: L is
 * the Laplacian with cotangent or uniform weights of a triangle or tetrahedral mesh, M the lumped
 * areas or volumes, s the Screening, f the source. The input is a mesh in pieces, as
 * vtkStreamingMeshReader delivers it; arrays are chosen by name with SetInputArrayToProcess()
 * (point arrays; the number of components of the values is the number of right-hand sides):
 * - 0: Dirichlet mask, not 0 where a point is constrained;
 * - 1: Dirichlet values, used at constrained points;
 * - 2: source (optional), a density;
 * - 3: initial guess (optional, else 0), used at free points.
 *
 * When data are first asked for, the filter pulls NumberOfPieces pieces of the input once, in
 * order, solves on scratch files and keeps the solution there. Then it answers any request for any
 * piece of any number of pieces: the piece of the input with the solution as a point array. It
 * solves again only after it, its input or a time-dependent input's time has changed. A request for
 * the whole mesh of a reader that answers with a preview gets the preview with the true solution at
 * its points.
 *
 * The report of the solve (JSON) is in the field data array `Report`. A solve that does not reach
 * Tolerance in MaximumCycles gives its last values, a warning, and Converged = 0.
 *
 * With more than one process, process 0 solves and sends the others the values of their points.
 * Requests that are streamed (see vtkStreamingMeshKeys) are answered by process 0 alone.
 *
 * @warning The input must keep the piece contract described at vtkStreamingMeshReader: filters in
 * between must pass point GlobalIds, vtkGhostType and StreamFinalized, and handle piece requests; a
 * source that gives the same data for every piece, has points that no cell uses, or does not number
 * its points by first use is refused.
 * @sa vtkStreamingMeshReader vtkStreamingMeshWriter
 */
#ifndef vtkStreamingPoisson_h
#define vtkStreamingPoisson_h

#include "vtkPassInputTypeAlgorithm.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr

class vtkMultiProcessController;

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingPoisson : public vtkPassInputTypeAlgorithm
{
public:
  static vtkStreamingPoisson* New();
  vtkTypeMacro(vtkStreamingPoisson, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The weights that the edges of the mesh can have. */
  enum WeightTypes
  {
    UNIFORM = 0,  ///< 1 on every edge
    COTANGENT = 1 ///< the finite-element stiffness, clamped from below
  };

  ///@{
  /** The weights of the edges. Default: COTANGENT. */
  vtkSetClampMacro(Weights, int, UNIFORM, COTANGENT);
  vtkGetMacro(Weights, int);
  ///@}

  ///@{
  /** Name of the multigrid's operator set. Default: "extended". */
  vtkSetStringMacro(Operators);
  vtkGetStringMacro(Operators);
  ///@}

  ///@{
  /** Gauss-Seidel sweeps before and after each coarse-level correction, 1 to 20. Default: 2. */
  vtkSetClampMacro(Sweeps, int, 1, 20);
  vtkGetMacro(Sweeps, int);
  ///@}

  ///@{
  /**
   * The solve ends when the norm of the residual is at most this fraction of the initial one; in
   * (0, 1). Default: 1e-6.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /** Most V-cycles, at least 1. Default: 50. */
  vtkSetClampMacro(MaximumCycles, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumCycles, int);
  ///@}

  ///@{
  /**
   * Memory that the solver may use, in MiB, at least 1. Default: 1024. If the mesh needs more, the
   * solve fails at once and says how much.
   */
  vtkSetClampMacro(MemoryLimit, int, 1, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

  ///@{
  /** Folder for scratch files. Default: none, which is the system's folder for temporary files. */
  vtkSetFilePathMacro(ScratchDirectory);
  vtkGetFilePathMacro(ScratchDirectory);
  ///@}

  ///@{
  /**
   * How many pieces the input is pulled in, 1 to 1,000,000. Default: 64. More pieces need less
   * memory. The solution does not depend on it.
   */
  vtkSetClampMacro(NumberOfPieces, int, 1, 1000000);
  vtkGetMacro(NumberOfPieces, int);
  ///@}

  ///@{
  /** Compute threads; 0 (default): one a core. The solution does not depend on it. */
  vtkSetClampMacro(NumberOfThreads, int, 0, 4096);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

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

  ///@{
  /**
   * The processes that work together: each asks for its own piece. Default: the global controller.
   * nullptr: this process works for itself.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() { return this->Controller; }
  ///@}

  ///@{
  /**
   * What the last solve came to: relative residual, V-cycles, passes over the mesh, most memory
   * that the solver used (bytes), whether it converged, and the whole report as JSON ("" before a
   * solve).
   */
  vtkGetMacro(Residual, double);
  vtkGetMacro(Cycles, int);
  vtkGetMacro(Passes, int);
  vtkGetMacro(PeakMemory, vtkIdType);
  vtkGetMacro(Converged, int);
  const char* GetReport();
  ///@}

protected:
  vtkStreamingPoisson();
  ~vtkStreamingPoisson() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkStreamingPoisson(const vtkStreamingPoisson&) = delete;
  void operator=(const vtkStreamingPoisson&) = delete;

  struct Internals;

  int Weights = COTANGENT;
  char* Operators = nullptr;
  int Sweeps = 2;
  double Tolerance = 1e-6;
  int MaximumCycles = 50;
  int MemoryLimit = 1024;
  char* ScratchDirectory = nullptr;
  int NumberOfPieces = 64;
  int NumberOfThreads = 0;
  double Screening = 0.0;
  bool InCore = false;
  char* ResultArrayName = nullptr;
  vtkMultiProcessController* Controller = nullptr;

  double Residual = 0.0;
  int Cycles = 0;
  int Passes = 0;
  vtkIdType PeakMemory = 0;
  int Converged = 0;

  std::unique_ptr<Internals> Internal;
};

#endif
