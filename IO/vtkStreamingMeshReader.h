// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshReader
 * @brief   Reads any piece of a gigantic mesh stream, and a preview of the whole
 *
 * Reads streaming meshes: .vsm containers, SMA and SMB (triangles), SVA and SVB (tetrahedra), and
 * every other mesh file that can be converted to a stream. A file that is not a .vsm is converted
 * once, when it is opened, to a temporary .vsm in ScratchDirectory. The output is a vtkPolyData for
 * triangles and a vtkUnstructuredGrid for tetrahedra.
 *
 * Piece p of N has the cells [C p/N, C (p+1)/N) in the order of the stream with all the points that
 * they use, and
 * - point GlobalIds: the stream index of each point;
 * - point array `vtkGhostType`: DUPLICATEPOINT on points that an earlier piece owns;
 * - point array `StreamFinalized`: 1 where no later piece uses the point;
 * - the file's point and cell columns as arrays, as far as they are selected; the cell column
 *   `CellFlags`, which marks duplicate and degenerate cells, always; columns named as the arrays
 *   above never.
 * The parts that are not ghosts make up the mesh, exactly, for every N. Pieces asked for in order
 * cost the piece alone, others cost the blocks of the file that hold them. Ghost levels are
 * ignored.
 *
 * A request for a piece of more than MaximumPointsInMemory points is answered with a preview,
 * unless it comes from a filter that streams (see vtkStreamingMeshKeys): at most PreviewPoints
 * points of the mesh with their GlobalIds and point arrays, joined by triangles by vertex
 * clustering, the surface only of tetrahedra, all of it in piece 0. Then the field data has the
 * arrays `Preview` (int, 1), `FullNumberOfPoints` and `FullNumberOfCells` (vtkIdType: the counts of
 * the mesh); the field data of a real piece has none of them. The preview costs one pass over the
 * file and is kept.
 *
 * Another source is a legal input of the streaming filters if it keeps this contract: every point
 * belongs to a cell, and the GlobalIds number the points in the order in which the cells, piece
 * after piece, use them first.
 *
 * @sa vtkStreamingMeshWriter vtkStreamingPoisson vtkStreamingMeshKeys
 */
#ifndef vtkStreamingMeshReader_h
#define vtkStreamingMeshReader_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkStreamingMultigridIOModule.h" // For export macro

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkDataArraySelection;

class VTKSTREAMINGMULTIGRIDIO_EXPORT vtkStreamingMeshReader : public vtkDataObjectAlgorithm
{
public:
  static vtkStreamingMeshReader* New();
  vtkTypeMacro(vtkStreamingMeshReader, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The file to read. */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The folder for the temporary container of a file that is not a .vsm. Default: none, which is
   * the folder for temporary files of the system.
   */
  vtkSetFilePathMacro(ScratchDirectory);
  vtkGetFilePathMacro(ScratchDirectory);
  ///@}

  ///@{
  /**
   * The most points that the answer to a request that is not streamed may have; a larger piece is
   * answered with the preview. Default: 2,000,000. 0: always the preview.
   */
  vtkSetClampMacro(MaximumPointsInMemory, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(MaximumPointsInMemory, vtkIdType);
  ///@}

  ///@{
  /** The most points that the preview may have, 8 to 1,000,000. Default: 10,000. */
  void SetPreviewPoints(int points);
  vtkGetMacro(PreviewPoints, int);
  ///@}

  ///@{
  /** Which columns of the points, and of the cells, become arrays. Default: all. */
  vtkDataArraySelection* GetPointDataArraySelection();
  vtkDataArraySelection* GetCellDataArraySelection();
  ///@}

  ///@{
  /** Counts of the whole mesh, after UpdateInformation(); -1 before. */
  vtkIdType GetFullNumberOfPoints();
  vtkIdType GetFullNumberOfCells();
  ///@}

  /** Most vertices alive at once in the stream, after UpdateInformation(); -1 before. */
  vtkIdType GetWidth();

  /** 1 if the file is of a format that can be read, by its content or its suffix; else 0. */
  static int CanReadFile(const char* name);

  /** Also the time of the array selections. */
  vtkMTimeType GetMTime() override;

protected:
  vtkStreamingMeshReader();
  ~vtkStreamingMeshReader() override;

  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;

  /** The file whose pieces are delivered: FileName. Empty as long as none is named. */
  virtual std::string GetContainerName();
  /**
   * Brings that file up to date: called before it is opened, and again when the properties,
   * FileName's file or that file have changed. Throws smg::Error if none is named, smg::Cancelled.
   */
  virtual void UpdateContainer();

private:
  vtkStreamingMeshReader(const vtkStreamingMeshReader&) = delete;
  void operator=(const vtkStreamingMeshReader&) = delete;

  char* FileName = nullptr;
  char* ScratchDirectory = nullptr;
  vtkIdType MaximumPointsInMemory = 2000000;
  int PreviewPoints = 10000;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
