// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshPreview
 * @brief   Makes a coarse mesh of a gigantic one
 *
 * Pulls NumberOfPieces pieces of the input once, in order, and makes a mesh of at most
 * PreviewPoints points by vertex clustering on a uniform grid: of triangles as they are, of
 * tetrahedra their outer surface. Memory is bounded by the preview and by the window of the stream.
 * The preview is kept until the filter or its input is modified.
 *
 * Every point is one of the mesh: its GlobalId says which one, and all point arrays have their
 * values there. The output has no cell arrays. Its field data are those of the preview that
 * vtkStreamingMeshReader shows of large meshes (`Preview`, `FullNumberOfPoints`,
 * `FullNumberOfCells`), so that filters treat it alike: vtkStreamingMeshDeformation deforms it in
 * memory.
 *
 * All of the preview is in piece 0, which process 0 makes. Streamed requests get the preview, too,
 * so that filters that need the mesh itself refuse it.
 *
 * @warning The input must keep the piece contract described at vtkStreamingSolver.
 * @sa vtkStreamingMeshReader vtkStreamingMeshDeformation
 */
#ifndef vtkStreamingMeshPreview_h
#define vtkStreamingMeshPreview_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingMeshPreview : public vtkPolyDataAlgorithm
{
public:
  static vtkStreamingMeshPreview* New();
  vtkTypeMacro(vtkStreamingMeshPreview, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The most points that the preview may have, 8 to 1,000,000; in general it has 70 to 100 % of it.
   * Default: 10,000.
   */
  void SetPreviewPoints(int points);
  vtkGetMacro(PreviewPoints, int);
  ///@}

  ///@{
  /**
   * How many pieces the input is pulled in, 1 to 1,000,000. Default: 64. More pieces need less
   * memory. The grid of the clusters is fitted to the first piece, so the preview is another one.
   */
  vtkSetClampMacro(NumberOfPieces, int, 1, 1000000);
  vtkGetMacro(NumberOfPieces, int);
  ///@}

  ///@{
  /** Points and cells of the mesh that the preview shows; 0 before it has been made. */
  vtkIdType GetFullNumberOfPoints();
  vtkIdType GetFullNumberOfCells();
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

  int PreviewPoints = 10000;
  int NumberOfPieces = 64;

  std::unique_ptr<Internals> Internal;
};

#endif
