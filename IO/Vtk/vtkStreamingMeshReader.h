// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshReader
 * @brief   Reads any piece of a very large mesh stream, and a preview of the whole
 *
 * Reads streaming meshes: .vsm containers, SMA and SMB (triangles), SVA and SVB (tetrahedra), and
 * every other mesh file that can be converted to a stream. A file that is not a .vsm is converted
 * to a temporary .vsm in ScratchDirectory. The output is a vtkPolyData for triangles and a
 * vtkUnstructuredGrid for tetrahedra.
 *
 * The conversion takes place when data are requested. UpdateInformation() reads what tells the type
 * of the output and the arrays: the header, or of formats that may hold either type of cells
 * (Medit, Gmsh, TetGen, VTK, VTKHDF) all up to the first cell, where binary data are skipped and
 * texts skimmed; if such a file is compressed, it is decompressed to a scratch file for that. What
 * only the whole file tells, the counts and arrays of labels, is known after Update(). A file that
 * is not valid up to there is an error of UpdateInformation(), one that is not valid further on of
 * Update().
 *
 * Piece p of N has the cells [C p/N, C (p+1)/N) in the order of the stream with all the points that
 * they use, and
 * - point GlobalIds: the stream index of each point;
 * - point array `vtkGhostType`: DUPLICATEPOINT on points that an earlier piece owns;
 * - point array `StreamFinalized`: 1 where no later piece uses the point; not of one piece of one;
 * - the selected point and cell columns of the file as arrays, and always the cell column
 *   `CellFlags`, which marks duplicate and degenerate cells; never columns with the names above.
 *
 * The union of the non-ghost parts is exactly the mesh, for every N. Requesting pieces in order
 * reads each piece alone, any other order the blocks of the file that contain it.
 *
 * With UPDATE_NUMBER_OF_GHOST_LEVELS, a piece also has so many layers of the cells around it, which
 * share points with the layer before, and their points: all in the order of the stream, and marked
 * in `vtkGhostType` of cells (DUPLICATECELL) and points. See smg::VsmReader::readPiece() for what
 * that costs.
 *
 * A file with time steps (VTKHDF) offers TIME_STEPS and TIME_RANGE. The step that was the last to
 * begin at UPDATE_TIME_STEP is converted when it is requested, and only that one is kept.
 *
 * A file that is replaced or changed while it is in use is an error of the next piece, until the
 * reader is modified: its pieces would not go with those before, nor with what filters made of
 * them. So is a property out of its range, before anything is read.
 *
 * A request for a piece of more than MaximumPointsInMemory points returns a preview, unless it
 * comes from a streaming filter (see vtkStreamingMeshKeys): the surface simplified to at most
 * PreviewPoints points of the mesh (see smg::simplify()), with their GlobalIds and point arrays,
 * all of it in piece 0. The field data then has the arrays `Preview` (int: 1, and the corners of
 * the cells of the mesh), `FullNumberOfPoints` and `FullNumberOfCells` (vtkIdType: the counts of
 * the mesh); the field data of a real piece has none of them. The preview takes one pass over the
 * file and is kept.
 *
 * Any other source is a valid input of the streaming filters if it fulfils this contract, every
 * point belongs to a cell, and the GlobalIds number the points in the order of their first use by
 * the cells, piece by piece.
 *
 * @sa vtkStreamingMeshWriter vtkStreamingPoisson vtkStreamingMeshKeys
 */
#ifndef vtkStreamingMeshReader_h
#define vtkStreamingMeshReader_h

#include "StreamingMeshProperties.h"
#include "vtkDataObjectAlgorithm.h"
#include "vtkStreamingMultigridIOModule.h" // For export macro

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkDataArraySelection;

namespace smg
{
struct ConversionOptions;
}

class VTKSTREAMINGMULTIGRIDIO_EXPORT vtkStreamingMeshReader : public vtkDataObjectAlgorithm
{
public:
  static vtkStreamingMeshReader* New();
  vtkTypeMacro(vtkStreamingMeshReader, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The file to read. */
  smgFileProperty(FileName);

  /** The folder for the temporary container of a file that is not a .vsm. Default: none (the
   * system's folder for temporary files). */
  smgFileProperty(ScratchDirectory);

  /** The maximum number of points of a piece that is not streamed; for a larger piece the preview
   * is returned. Default: 2,000,000. 0: always the preview. */
  smgProperty(MaximumPointsInMemory, vtkIdType);

  /** The maximum number of points of the preview, 8 to 1,000,000. Making it takes up to 3.5 KB of
   * memory a point. Default: 100,000. */
  smgProperty(PreviewPoints, int);

  /** What the preview of a tetrahedral mesh consists of. */
  enum PreviewCellsType
  {
    SURFACE,   ///< triangles of its outer surface: the shape in most detail
    TETRAHEDRA ///< fewer and larger tetrahedra, on which a deformation acts inside, too
  };
  /** What the preview of a tetrahedral mesh consists of. Default: SURFACE. */
  smgProperty(PreviewCells, int);

  ///@{
  /** The point and cell columns to read as arrays. Default: all. */
  vtkDataArraySelection* GetPointDataArraySelection();
  vtkDataArraySelection* GetCellDataArraySelection();
  ///@}

  ///@{
  /** Counts of the whole mesh: of a .vsm file after UpdateInformation(), of others, which are
   * converted when data are requested, after Update(); -1 before. */
  vtkIdType GetFullNumberOfPoints();
  vtkIdType GetFullNumberOfCells();

  /** What the last request showed, as "All 34,834 points." or "A preview: 2,000 of 34,834 points.",
   * or why it failed; "" before. */
  const char* GetOutcome();

  /** Why it failed, by itself or by an algorithm before it; empty: it did not. */
  const char* GetError();
  ///@}

  /** The maximum number of simultaneously active vertices of the stream, known when the counts are;
   * -1 before. */
  vtkIdType GetWidth();

  /** Whether the opened file has not been changed since; false before one is opened. */
  bool IsFileUnchanged();

  /** Returns 1 if the format of the file, by its content or its suffix, can be read, else 0. */
  static int CanReadFile(const char* name);

  /** Includes the modification time of the array selections. */
  vtkMTimeType GetMTime() override;

protected:
  vtkStreamingMeshReader();
  ~vtkStreamingMeshReader() override;

  /** After a failure, looks whether files have changed since, once for every update. */
  int ComputePipelineMTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector, int port, vtkMTimeType* time) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  /** Converts a file of which the pipeline knows only the beginning. */
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;

  /** The file whose pieces are delivered: FileName. Empty if none is set. */
  virtual std::string GetContainerName();
  /** Whether that file is there and up to date, so that UpdateContainer() takes no conversion. */
  virtual bool IsContainerMade();
  /** Sets what is to be converted: the cells, the time step, the partition. The reader: the time
   * step alone, which is set before. */
  virtual void ChooseConversion(smg::ConversionOptions& options);
  /** Updates that file; called before it is opened, and again when the properties, the file of
   * FileName or that file have changed. Throws smg::Error if none is set, and smg::Cancelled. */
  virtual void UpdateContainer();

private:
  vtkStreamingMeshReader(const vtkStreamingMeshReader&) = delete;
  void operator=(const vtkStreamingMeshReader&) = delete;

  std::string FileName;
  std::string ScratchDirectory;
  vtkIdType MaximumPointsInMemory = 2000000;
  int PreviewPoints = 100000;
  int PreviewCells = SURFACE;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
