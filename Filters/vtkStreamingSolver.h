// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingSolver
 * @brief   What the filters that solve on gigantic meshes out of core have in common
 *
 * The input is a mesh in pieces, as vtkStreamingMeshReader delivers it. When data are first asked
 * for, the filter pulls NumberOfPieces pieces of the input once, in order, solves on scratch files
 * and keeps the solution there. Then it answers any request for any piece of any number of pieces:
 * the piece of the input with what the subclass makes of the solution at its points. It solves
 * again only after it, its input or a time-dependent input's time has changed.
 *
 * The report of the solve (JSON) is in the field data array `Report`. A solve that does not reach
 * Tolerance in MaximumCycles gives its last values, a warning, and Converged = 0.
 *
 * With more than one process, process 0 solves and sends the others the values of their points;
 * what fails in one process, fails in all. Requests that are streamed (see vtkStreamingMeshKeys)
 * are answered by process 0 alone.
 *
 * @warning The input must keep the piece contract described at vtkStreamingMeshReader: filters in
 * between must pass point GlobalIds, vtkGhostType and StreamFinalized, and handle piece requests; a
 * source that gives the same data for every piece, has points that no cell uses, or does not number
 * its points by first use is refused.
 * @sa vtkStreamingPoisson vtkStreamingMeshDeformation vtkStreamingMeshReader
 */
#ifndef vtkStreamingSolver_h
#define vtkStreamingSolver_h

#include "vtkPassInputTypeAlgorithm.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <functional> // For std::function
#include <memory>     // For std::unique_ptr
#include <vector>     // For std::vector

class vtkMultiProcessController;
class vtkPointSet;

namespace smg
{
enum class Weights;
struct SolveOptions;
struct SolveSummary;
class StreamedTask;
} // namespace smg

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingSolver : public vtkPassInputTypeAlgorithm
{
public:
  vtkTypeMacro(vtkStreamingSolver, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The weights that the edges of the mesh can have. */
  enum WeightTypes
  {
    UNIFORM = 0,   ///< 1 on every edge
    COTANGENT = 1, ///< the stiffness of linear finite elements itself
    CLAMPED = 2    ///< the same, raised to a positive floor: it keeps the maximum principle
  };

  ///@{
  /** The weights of the edges. Default: COTANGENT; of vtkStreamingMeshDeformation: CLAMPED. */
  vtkSetClampMacro(Weights, int, UNIFORM, CLAMPED);
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
  /**
   * The processes that work together: each asks for its own piece. Default: the global controller.
   * nullptr: this process works for itself.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() { return this->Controller; }
  ///@}

  ///@{
  /**
   * What the last solve came to: relative residual, passes over the mesh, most memory that the
   * solver used (bytes), whether it converged (0 also if what is asked for since could not be
   * solved), all that in a line, or why there is none, what else there is to say (a line a note),
   * and the whole report as JSON (the last three are "" before a solve).
   */
  double GetResidual();
  int GetPasses();
  vtkIdType GetPeakMemory();
  int GetConverged();
  const char* GetOutcome();
  const char* GetNotes();
  const char* GetReport();
  ///@}

protected:
  vtkStreamingSolver();
  ~vtkStreamingSolver() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * What is to be computed on the whole mesh, of which `input` is some piece. Throws smg::Error if
   * the properties or the arrays of the input do not allow it.
   */
  virtual std::unique_ptr<smg::StreamedTask> MakeTask(vtkPointSet& input) = 0;

  /** Gives the output what is made of a piece and of the values at its points. */
  virtual void Deliver(
    vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output) = 0;

  /**
   * Whether `input`, which is the preview or (`isWhole`) the whole mesh, is to be solved on in
   * memory, instead of the whole mesh out of core. Asked in process 0, of requests that are not
   * streamed. Default: never.
   */
  virtual bool IsForMemory(vtkPointSet& input, bool isWhole);

  /** Solves on `input` in memory and gives the values of all its points. Throws smg::Error. */
  virtual smg::SolveSummary SolveInMemory(
    vtkPointSet& input, const std::function<bool(double)>& progress, std::vector<double>& values);

  /** Of a piece without points of what was solved on in memory, with so many values a point:
   * nothing of what is known changes. */
  smg::SolveSummary SummaryOfNothing(int columns) const;

  /** Whether a solve that does not reach the tolerance is worth a warning. Default: yes. */
  virtual bool IsToConverge() { return true; }

  /** The options that the properties stand for. */
  void FillOptions(smg::SolveOptions& options) const;
  smg::Weights ChosenWeights() const;

  /** What is known of the last solve. */
  const smg::SolveSummary& GetSummary() const;

private:
  vtkStreamingSolver(const vtkStreamingSolver&) = delete;
  void operator=(const vtkStreamingSolver&) = delete;

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
  vtkMultiProcessController* Controller = nullptr;

  std::unique_ptr<Internals> Internal;
};

#endif
