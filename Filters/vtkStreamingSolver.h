// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingSolver
 * @brief   Base class of filters that solve on very large meshes out of core
 *
 * The input is a mesh in pieces, as delivered by vtkStreamingMeshReader. On the first request, the
 * filter requests NumberOfPieces pieces of the input once, in order, solves with scratch files and
 * keeps the solution there. It then delivers any piece of any number of pieces: the piece of the
 * input with the data that the subclass computes from the solution at its points. It solves again
 * only if the filter, its input or the time of a time-dependent input has changed.
 *
 * The report of the solve (JSON) is in the field data array `Report`. A solve that does not reach
 * Tolerance within MaximumCycles returns its last values with a warning, and Converged is 0. A
 * property out of its range is an error of the update, before anything is computed.
 *
 * With several processes, process 0 solves and sends the others the values of their points; a
 * failure in one process is a failure in all. Process 0 alone processes streamed requests (see
 * vtkStreamingMeshKeys).
 *
 * @warning The input must fulfil the piece contract described at vtkStreamingMeshReader: filters in
 * between must pass point GlobalIds, vtkGhostType and StreamFinalized, and handle piece requests. A
 * source that returns the same data for every piece, has points that no cell uses, or does not
 * number its points by first use is rejected.
 * @sa vtkStreamingPoisson vtkStreamingMeshDeformation vtkStreamingMeshReader
 */
#ifndef vtkStreamingSolver_h
#define vtkStreamingSolver_h

#include "StreamingMeshProperties.h" // For the macros of properties
#include "vtkPassInputTypeAlgorithm.h"
#include "vtkSmartPointer.h"                    // For vtkSmartPointer
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <functional> // For std::function
#include <memory>     // For std::unique_ptr
#include <string>     // For std::string
#include <vector>     // For std::vector

class vtkMultiProcessController;
class vtkPointSet;

namespace smg
{
enum class Weights;
class JobProperties;
struct SolveOptions;
struct SolveSummary;
class JobTask;
} // namespace smg

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingSolver : public vtkPassInputTypeAlgorithm
{
public:
  vtkTypeMacro(vtkStreamingSolver, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The weights of the edges of the mesh. */
  enum WeightTypes
  {
    UNIFORM = 0,   ///< 1 on every edge
    COTANGENT = 1, ///< the stiffness of linear finite elements
    CLAMPED = 2    ///< the same, raised to a positive floor: satisfies the maximum principle
  };

  /** The outputs. */
  enum OutputPorts
  {
    MESH = 0,   ///< the mesh with the result
    PASSES = 1, ///< a vtkTable with a row for each pass: residual, seconds, bytes, memory
    TEXT = 2,   ///< a vtkTable with one sentence for the view: whether it shows a preview's result
    NUMBER_OF_OUTPUT_PORTS = 3
  };

  /** Where to solve while the preview of a mesh is shown. */
  enum SolveTypes
  {
    AUTOMATIC_SOLVE =
      0,             ///< on the full mesh if the estimate is below 20 s of CPU, else the preview
    ON_PREVIEW = 1,  ///< on the preview, in memory, as an approximation
    ON_FULL_MESH = 2 ///< on the full mesh; the preview then has its values
  };

  /**
   * Where to solve while the preview of a mesh is shown: see SolveTypes. What is saved is always
   * that of the full mesh. GetOutcome() says first which of them it was. Default: AUTOMATIC_SOLVE;
   * for vtkStreamingMeshDeformation: ON_PREVIEW.
   */
  smgProperty(Solve, int);

  /** The weights of the edges. Default: COTANGENT; for vtkStreamingMeshDeformation: CLAMPED. */
  smgProperty(Weights, int);

  /** Name of the multigrid's operator set. Default: "extended". */
  smgTextProperty(Operators);

  /** Gauss-Seidel sweeps before and after each coarse-grid correction, 1 to 20. Default: 2. */
  smgOption(Sweeps, int);

  /**
   * The solve ends when the norm of the residual is at most this fraction of that of the best
   * constant, or of the mesh at rest where it is moved; in (0, 1).
   * Default: 1e-8, with which the result agrees with that of a direct solver to the digits of a
   * float; of Streaming Mesh Deformation 1e-6.
   */
  smgOption(Tolerance, double);

  /** The maximum number of V-cycles, 1 to 1,000,000. Default: 50. */
  smgOption(MaximumCycles, int);

  /** The memory limit of the solver in MiB, at least 1. Default: 1024. If the mesh needs more, the
   * solve fails immediately and states how much. Scratch files in memory (see ScratchDirectory)
   * take at most half of it, besides. */
  smgProperty(MemoryLimit, int);

  /** The folder for scratch files. Default: none: the system's folder for temporary files; of an
   * ordinary mesh the system's folder in memory, /dev/shm, if half of MemoryLimit has room for
   * them.
   */
  smgFileProperty(ScratchDirectory);

  /** The limit of the scratch files that exist at once, in MiB; 0 (default): none. Before it is
   * exceeded, the solve fails with an error that states both figures. The files of a checkpoint
   * have this limit for themselves. */
  smgProperty(ScratchLimit, int);

  /**
   * A folder from which the same filter on the same input, in another program, continues the solve
   * if this program is killed or the solve is aborted. The folder is for this filter alone: it is
   * made, and removed when the filter solves something else. When the filter is deleted, it
   * remains, since the filter does not know whether its output has been written; with it the same
   * filter has its solution at once. Remove it when the result is safe. vtkStreamingPoisson and
   * vtkStreamingMeshDeformation have checkpoints, when they do not solve in memory; the other
   * subclasses fail with one. Default: none.
   */
  smgFileProperty(CheckpointDirectory);

  /** The number of pieces in which the input is requested, 0 to 1,000,000. Default: 0 (at least 64,
   * and such that a piece takes at most a sixteenth of MemoryLimit). More pieces need less memory.
   * The solution does not depend on it. */
  smgProperty(NumberOfPieces, int);

  /** Compute threads, at most 1024; 0 (default): one per core. The solution does not depend on it.
   */
  smgOption(NumberOfThreads, int);

  ///@{
  /** The controller of the processes that work together, each requesting its own piece. Default:
   * the global controller. nullptr: this process works alone. */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() { return this->Controller; }
  ///@}

  /**
   * What a solve on the whole mesh is expected to cost, in one line: accounted memory, scratch
   * files, passes, processor time, and the size of the mesh with its result as .vsm. The input is
   * not executed: after UpdateInformation(), the counts are those of the .vsm file of its reader.
   * For other inputs a sentence says that nothing is known.
   */
  const char* GetEstimate();

  ///@{
  /**
   * The outcome of the last solve: relative residual, passes over the mesh, peak memory of the
   * solver (bytes), whether it converged (0 also if a later request failed), a summary in one line
   * or the reason of a failure, the notes (one per line), and the whole report as JSON (the last
   * three are "" before a solve).
   */
  double GetResidual();
  int GetPasses();
  vtkIdType GetPeakMemory();
  int GetConverged();
  const char* GetOutcome();
  const char* GetNotes();
  const char* GetReport();
  ///@}

  /** Why the last request failed; "": it did not. */
  const char* GetError();

protected:
  /** @param job the kind of the job that it does, whose options are its properties */
  explicit vtkStreamingSolver(const char* job = "solve");
  ~vtkStreamingSolver() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /** Creates the task to compute on the whole mesh, of which `input` is some piece. Throws
   * smg::Error if the properties or the arrays of the input do not allow it. Default: the job, as
   * FillTask() fills it. */
  virtual std::unique_ptr<smg::JobTask> MakeTask(vtkPointSet& input);
  /** Sets limits, options and parts of the mesh, those of the regions of the input first, according
   * to the properties. Throws smg::Error. */
  void FillTask(smg::JobTask& task, vtkPointSet& input) const;

  /** Creates the task of GetEstimate() from what the input delivered last, which may have neither
   * points nor arrays. Default: MakeTask(). */
  virtual std::unique_ptr<smg::JobTask> MakeEstimatedTask(vtkPointSet& input);

  /** Fills the outputs besides the mesh from a solve, or from that of none. */
  virtual void FillFurtherOutputs(
    const smg::SolveSummary& summary, vtkInformationVector& outputVector);

  /** Fills the output from a piece and the values at its points. */
  virtual void Deliver(
    vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output) = 0;

  /**
   * Whether to solve on `input`, the preview or (`isWhole`) the whole mesh, in memory, instead of
   * on the whole mesh out of core. Called in process 0, for requests that are not streamed.
   * Default: on the preview of a surface, or on one of tetrahedra, if Solve says so; the surface of
   * a solid is another mesh.
   */
  virtual bool IsForMemory(vtkPointSet& input, bool isWhole);

  /** Whether Solve says to solve on the preview that is shown. */
  bool IsForPreview();

  /** The mesh to solve on instead of `input`, which is a preview or a whole mesh, if it is solved
   * on in memory. Default: `input`. */
  virtual vtkSmartPointer<vtkPointSet> MeshInMemory(vtkPointSet& input);

  /** Replaces the values of a solution on another mesh of MeshInMemory() by those at the points of
   * `input`. */
  virtual void SpreadValues(vtkPointSet& input, int columns, std::vector<double>& values);

  /**
   * Whether the processes solve together on the pieces that they have, instead of process 0 alone
   * out of core. Called in all of them for one request, unless this process answers it alone
   * (`isAlone`): then this is not to be. Default: false.
   */
  virtual bool IsForProcesses(vtkPointSet& piece, bool isAlone);

  /** Solves so, and returns the values at all points of the piece of this process. Called in all
   * processes. Throws smg::Error in all of them if one fails. */
  virtual smg::SolveSummary SolveInProcesses(
    vtkPointSet& piece, const std::function<bool(double)>& progress, std::vector<double>& values);

  /** Creates the task for a coarser preview, with whose values those on a preview are compared to
   * say how far they may be off. Default: MakeTask(). */
  virtual std::unique_ptr<smg::JobTask> MakeCoarserTask(vtkPointSet& coarser);
  /** How many of the `columns` values of a point that comparison takes as a vector. Default: all.
   */
  virtual int ComparedColumns(int columns) { return columns; }

  /** Whether to warn if a solve does not reach the tolerance. Default: true. */
  virtual bool IsToConverge() { return true; }

  /** Throws smg::Error if a property is out of its range. Subclasses add their own. */
  virtual void CheckRanges() const;
  /** What the libraries say, in the words of a user of panels and properties. */
  virtual std::string InPanelWords(const std::string& text);
  /** A sentence about a property that is set but has no effect with the others, for a warning; ""
   * if there is none. */
  virtual std::string UnusedProperty();
  /** Sets the options according to the properties. */
  void FillOptions(smg::SolveOptions& options) const;
  smg::Weights ChosenWeights() const;

  /** The summary of the last solve. */
  const smg::SolveSummary& GetSummary() const;
  /** The same, unless it is of an input or of properties that have changed since: then that of no
   * solve. */
  const smg::SolveSummary& GetPresentSummary() const;

  /** The properties that are options of the job. */
  std::unique_ptr<smg::JobProperties> Options;

private:
  vtkStreamingSolver(const vtkStreamingSolver&) = delete;
  void operator=(const vtkStreamingSolver&) = delete;

  struct Internals;

  const char* const Job; ///< its kind
  int Solve = AUTOMATIC_SOLVE;
  int Weights = COTANGENT;
  std::string Operators = "extended";
  int MemoryLimit = 1024;
  std::string ScratchDirectory;
  int ScratchLimit = 0;
  std::string CheckpointDirectory;
  int NumberOfPieces = 0;
  vtkMultiProcessController* Controller = nullptr;

  std::unique_ptr<Internals> Internal;
};

#endif
