// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshSimplification
 * @brief   Simplifies a very large surface by collapsing edges
 *
 * Reads a mesh once, piece by piece and in bounded memory, and collapses edges, those that change
 * the surface least first, until NumberOfVertices or MaximumError is reached; of a tetrahedral
 * mesh, its outer surface (see smg::simplify()). Every point of the result is a point of the mesh,
 * with its point arrays and with `OriginalId`. Bodies, holes and winding stay. A triangle of
 * the result has the cell arrays of one of the mesh, whose corners have moved, and the borders
 * between labels, arrays of few integers, are held; those of tetrahedra are not in the result,
 * which Outcome says. Regions that vtkMeshRegion has marked are held, and what Hold names: all of
 * their points that are on the surface are points of the result. It is kept in a scratch file until
 * the filter or its input is modified, and delivered as the pieces of a mesh stream, as those of
 * vtkStreamingMeshReader.
 *
 * The input is that of vtkStreamingSolver: pieces, or any vtkPolyData or vtkUnstructuredGrid. With
 * several processes, process 0 delivers all of the result in its piece.
 *
 * @sa vtkStreamingMeshPreview vtkStreamingMeshReader
 */
#ifndef vtkStreamingMeshSimplification_h
#define vtkStreamingMeshSimplification_h

#include "StreamingMeshProperties.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingMeshSimplification
  : public vtkPolyDataAlgorithm
{
public:
  static vtkStreamingMeshSimplification* New();
  vtkTypeMacro(vtkStreamingMeshSimplification, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The most points of the result, at least 4; 0: as many as MaximumError needs. Default: 100,000.
   */
  smgOption(NumberOfVertices, vtkIdType);

  /** The largest error, in the unit of the mesh: see smg::SimplifyOptions. 0 (default): what
   * NumberOfVertices needs. With both, what comes first ends the simplification. */
  smgOption(MaximumError, double);

  /** The parts whose points all stay, in addition to the regions that vtkMeshRegion has marked:
   * WHERE of a problem file in JSON, or a list of these, for example {"sphere": [0, 0, 0, 1]}.
   * Columns are arrays of the input. Default: none. */
  smgTextOption(Hold);

  /** The memory limit in MiB, at least 16. Default: 256. The result depends on it. */
  smgProperty(MemoryLimit, int);

  /** The folder for scratch files. Default: none (the system's folder for temporary files). */
  smgFileProperty(ScratchDirectory);

  /** The number of pieces in which the input is requested, 0 to 1,000,000. Default: 0 (at least 64,
   * and pieces of at most 64 MiB). */
  smgProperty(NumberOfPieces, int);

  /** Compute threads, at most 1024; 0 (default): one per core. The result does not depend on it. */
  smgOption(NumberOfThreads, int);

  /** What a simplification of the whole mesh is expected to cost, in one line: memory, scratch
   * files, processor time and the size of the result, which with MaximumError alone is that of the
   * mesh at most; or why that is not known. Requests nothing from the input: after
   * UpdateInformation(), the counts are those of the .vsm file of its reader. */
  const char* GetEstimate();

  ///@{
  /** Of the last result: the largest error, what was done in one line or why it failed, and the
   * report as JSON; "" before. */
  double GetReachedError();
  const char* GetOutcome();
  const char* GetReport();
  ///@}

  /** Why the last request failed; "": it did not. */
  const char* GetError();

protected:
  vtkStreamingMeshSimplification();
  ~vtkStreamingMeshSimplification() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkStreamingMeshSimplification(const vtkStreamingMeshSimplification&) = delete;
  void operator=(const vtkStreamingMeshSimplification&) = delete;

  struct Internals;

  int MemoryLimit = 256;
  std::string ScratchDirectory;
  int NumberOfPieces = 0;

  std::unique_ptr<smg::JobProperties> Options;
  std::unique_ptr<Internals> Internal;
};

#endif
