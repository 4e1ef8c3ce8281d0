// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshDeformation
 * @brief   Deforms a gigantic mesh by handles and keeps its details
 *
 * Deforms a mesh of triangles or tetrahedra by the handles in its point arrays HandleMask,
 * HandleTarget, HandleRotation and HandleLogScale, which vtkMeshHandle makes: two Poisson problems,
 * the rotations and scales between the handles, then the positions. Parts of the mesh that no
 * handle reaches stay as they are. The output is the input with its points moved, in their
 * precision, and with all its arrays but the handles' (see KeepHandleArrays) and old normals (see
 * Normals).
 *
 * - Streamed requests (see vtkStreamingMeshKeys), those of writers and other streaming filters, are
 *   answered as told at vtkStreamingSolver: the whole mesh is deformed once, out of core.
 * - Other requests that the input answers with a preview give the deformed preview: it is deformed
 *   by itself, in memory, and its hierarchy is kept as long as only the motion of the handles
 *   changes. So a handle can be dragged and the preview follows at once.
 * - Other requests for the whole of a mesh of at most InteractivePoints points are answered in the
 *   same way with the mesh itself; those for larger meshes, or with several processes, as the
 *   streamed ones.
 *
 * All ways give the same mesh the same points, bit for bit. A mesh that is deformed in memory may
 * be any mesh; one that is streamed has to keep the contract told at vtkStreamingSolver.
 *
 * @sa vtkMeshHandle vtkStreamingSolver vtkStreamingMeshPreview vtkStreamingMeshReader
 */
#ifndef vtkStreamingMeshDeformation_h
#define vtkStreamingMeshDeformation_h

#include "vtkStreamingMultigridFiltersModule.h" // For export macro
#include "vtkStreamingSolver.h"

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingMeshDeformation : public vtkStreamingSolver
{
public:
  static vtkStreamingMeshDeformation* New();
  vtkTypeMacro(vtkStreamingMeshDeformation, vtkStreamingSolver);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** What becomes of normals. */
  enum NormalsTypes
  {
    RECOMPUTE = 0, ///< those of triangles are computed anew; those of tetrahedra dropped
    DROP = 1       ///< they are dropped
  };

  ///@{
  /**
   * V-cycles of each of the two steps. Default: 0, which is as many as Tolerance needs, at most
   * MaximumCycles.
   */
  vtkSetClampMacro(Cycles, int, 0, VTK_INT_MAX);
  vtkGetMacro(Cycles, int);
  ///@}

  ///@{
  /**
   * What becomes of the normals of points and of cells (the active normals and arrays `Normals`),
   * which are not true any more. Default: RECOMPUTE. The normals of points are averages over the
   * whole mesh, weighted by angles, in single precision; they do not depend on pieces. Active
   * tangents are always dropped.
   */
  vtkSetClampMacro(Normals, int, RECOMPUTE, DROP);
  vtkGetMacro(Normals, int);
  ///@}

  ///@{
  /**
   * Whether the output keeps the arrays of the handles. Default: off, so that the handles of a
   * second deformation begin from nothing.
   */
  vtkSetMacro(KeepHandleArrays, bool);
  vtkGetMacro(KeepHandleArrays, bool);
  vtkBooleanMacro(KeepHandleArrays, bool);
  ///@}

  ///@{
  /**
   * Meshes of at most so many points are deformed in memory, where that takes about 1 KiB a point,
   * and their hierarchy is kept. Default: 200,000. 0: only previews are. The result is the same. A
   * larger mesh of which no preview is displayed is deformed out of core at each change.
   */
  vtkSetClampMacro(InteractivePoints, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(InteractivePoints, vtkIdType);
  ///@}

  /**
   * How many times a hierarchy has been built in memory: this does not grow while only the motion
   * of handles changes.
   */
  int GetNumberOfBuilds();

protected:
  vtkStreamingMeshDeformation();
  ~vtkStreamingMeshDeformation() override;

  std::unique_ptr<smg::StreamedTask> MakeTask(vtkPointSet& input) override;
  void Deliver(vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output) override;
  bool IsForMemory(vtkPointSet& input, bool isWhole) override;
  smg::SolveSummary SolveInMemory(vtkPointSet& input, const std::function<bool(double)>& progress,
    std::vector<double>& values) override;
  bool IsToConverge() override { return this->Cycles == 0; }

private:
  vtkStreamingMeshDeformation(const vtkStreamingMeshDeformation&) = delete;
  void operator=(const vtkStreamingMeshDeformation&) = delete;

  struct Internals;

  int Cycles = 0;
  int Normals = RECOMPUTE;
  bool KeepHandleArrays = false;
  vtkIdType InteractivePoints = 200000;

  std::unique_ptr<Internals> Internal;
};

#endif
