// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshPreview
 * @brief   Creates a coarse mesh from a very large one
 *
 * Requests NumberOfPieces pieces of the input once, in order, and creates a mesh of at most
 * PreviewPoints points by collapsing edges of the triangles, or of the outer surface of tetrahedra
 * (see smg::simplify()). Memory is bounded: 320 MiB suffice for 100,000 points. The preview is kept
 * until the filter or its input is modified.
 *
 * Every point is a point of the mesh, identified by its GlobalId, with the values of all point
 * arrays. The output has no cell arrays. Its field data are those of a preview of
 * vtkStreamingMeshReader (`Preview`, `FullNumberOfPoints`, `FullNumberOfCells`), so that filters
 * treat both alike: vtkStreamingMeshDeformation deforms it in memory.
 *
 * Piece 0, created by process 0, contains the whole preview. Streamed requests also return the
 * preview, so that filters that need the mesh itself reject it.
 *
 * @warning The input must fulfil the piece contract described at vtkStreamingSolver.
 * @sa vtkStreamingMeshReader vtkStreamingMeshDeformation
 */
#ifndef vtkStreamingMeshPreview_h
#define vtkStreamingMeshPreview_h

#include "StreamingMeshProperties.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingMeshPreview : public vtkPolyDataAlgorithm
{
public:
  static vtkStreamingMeshPreview* New();
  vtkTypeMacro(vtkStreamingMeshPreview, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The maximum number of points of the preview, 8 to 1,000,000; it usually has as many. Default:
   * 100,000. */
  smgProperty(PreviewPoints, int);

  /**
   * The number of pieces in which the input is requested, 0 to 1,000,000. Default: 0 (at least 64,
   * and pieces of at most 64 MiB). More pieces need less memory.
   */
  smgProperty(NumberOfPieces, int);

  ///@{
  /** Points and cells of the mesh that the preview represents; 0 before it has been created. */
  vtkIdType GetFullNumberOfPoints();
  vtkIdType GetFullNumberOfCells();

  /** Points and triangles of the last preview, and what it does not show, as `smg preview` says it;
   * or why it failed. */
  const char* GetOutcome();
  /** Why it failed, by itself or by an algorithm before it; empty: it did not. */
  const char* GetError();
  ///@}

protected:
  vtkStreamingMeshPreview();
  ~vtkStreamingMeshPreview() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkStreamingMeshPreview(const vtkStreamingMeshPreview&) = delete;
  void operator=(const vtkStreamingMeshPreview&) = delete;

  struct Internals;

  int PreviewPoints = 100000;
  int NumberOfPieces = 0;

  std::unique_ptr<Internals> Internal;
};

#endif
