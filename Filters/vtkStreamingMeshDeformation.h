// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshDeformation
 * @brief   Deforms a very large mesh by handles and keeps its details
 *
 * Deforms a mesh of triangles or tetrahedra by the handles in its point arrays HandleMask,
 * HandleTarget, HandleRotation and HandleLogScale, which vtkMeshHandle creates. It solves two
 * Poisson problems: one for the rotations and scales between the handles, one for the positions.
 * Components of the mesh without a handle do not move. The output is the input with its points
 * moved, in their precision, and with all its arrays except those of the handles (see
 * KeepHandleArrays) and the old normals (see Normals).
 *
 * - For streamed requests (see vtkStreamingMeshKeys), those of writers and other streaming filters,
 *   the whole mesh is deformed once, out of core, as described at vtkStreamingSolver.
 * - For other requests, if the input is a preview and Solve says so, that is deformed in memory,
 *   made coarser to DragPoints, whose motion all its points follow. Its hierarchy is kept as long
 *   as only the motion of the handles changes, so that it follows a dragged handle immediately.
 * - Other requests for the whole of a mesh of at most InteractivePoints points, which needs no more
 *   than MemoryLimit in memory, are treated like previews; those for larger meshes, or with several
 *   processes, like streamed requests.
 *
 * In all cases but previews a stream gets the same points, bit for bit, and any other mesh, which
 * is ordered out of core, the same ones up to Tolerance. With several processes that
 * have memory for the matrix, Engine deforms on all of them together, previews excepted, and the
 * points are the same up to Tolerance; Cycles must be 0, then. Any mesh can be deformed in memory;
 * a streamed mesh has to fulfil the contract described at vtkStreamingSolver.
 *
 * @sa vtkMeshHandle vtkMultiEngineSolver vtkStreamingSolver vtkStreamingMeshPreview
 * vtkStreamingMeshReader
 */
#ifndef vtkStreamingMeshDeformation_h
#define vtkStreamingMeshDeformation_h

#include "vtkMultiEngineSolver.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingMeshDeformation : public vtkMultiEngineSolver
{
public:
  static vtkStreamingMeshDeformation* New();
  vtkTypeMacro(vtkStreamingMeshDeformation, vtkMultiEngineSolver);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The treatment of normals. */
  enum NormalsTypes
  {
    RECOMPUTE = 0, ///< those of triangles are recomputed, those of tetrahedra dropped
    DROP = 1       ///< they are dropped
  };

  /** V-cycles of each of the two steps. Default: 0 (as many as Tolerance needs, at most
   * MaximumCycles). */
  smgOption(Cycles, int);

  /**
   * The treatment of the normals of points and of cells (the active normals and arrays `Normals`),
   * which the deformation invalidates. Default: RECOMPUTE. Point normals are averages over the
   * whole mesh, weighted by angles, in single precision; they do not depend on pieces. Active
   * tangents are always dropped.
   */
  smgOption(Normals, int);

  /** Whether the output keeps the arrays of the handles. Default: off, so that a second deformation
   * starts without handles. */
  smgFlagProperty(KeepHandleArrays);

  /**
   * Meshes of at most this many points are deformed in memory, which takes about 1 KiB per point,
   * and their hierarchy is kept. Default: 200,000. 0: only previews. The result does not depend on
   * it. A larger mesh that is displayed without a preview is deformed out of core at each change.
   */
  smgProperty(InteractivePoints, vtkIdType);

  /** A preview of more points is made coarser before it is deformed, so that it follows a dragged
   * handle; at least 8. Default: 10,000, which answer in about 40 ms. */
  smgProperty(DragPoints, vtkIdType);

  /** The number of hierarchies built in memory; it does not increase while only the motion of
   * handles changes. */
  int GetNumberOfBuilds();

protected:
  vtkStreamingMeshDeformation();
  ~vtkStreamingMeshDeformation() override;

  void CheckRanges() const override;
  std::unique_ptr<smg::JobTask> MakeEstimatedTask(vtkPointSet& input) override;
  std::unique_ptr<smg::JobTask> MakeCoarserTask(vtkPointSet& coarser) override;
  std::unique_ptr<smg::JobTask> MakeTask(vtkPointSet& input) override;
  void Deliver(vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output) override;
  bool IsForMemory(vtkPointSet& input, bool isWhole) override;
  vtkSmartPointer<vtkPointSet> MeshInMemory(vtkPointSet& input) override;
  void SpreadValues(vtkPointSet& input, int columns, std::vector<double>& values) override;
  smg::SolveSummary SolveInProcesses(vtkPointSet& piece,
    const std::function<bool(double)>& progress, std::vector<double>& values) override;
  std::string WhyStreaming() override;
  int GetUsualColumns() override { return 7; }                // of both steps
  int ComparedColumns(int /*columns*/) override { return 3; } // without normals
  bool IsToConverge() override { return this->GetCycles() == 0; }

private:
  vtkStreamingMeshDeformation(const vtkStreamingMeshDeformation&) = delete;
  void operator=(const vtkStreamingMeshDeformation&) = delete;

  struct Internals;

  bool KeepHandleArrays = false;
  vtkIdType InteractivePoints = 200000;
  vtkIdType DragPoints = 10000;

  std::unique_ptr<Internals> Internal;
};

#endif
