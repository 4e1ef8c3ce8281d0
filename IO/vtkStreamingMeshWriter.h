// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshWriter
 * @brief   Writes a gigantic mesh piece by piece
 *
 * Pulls the pieces of its input one after the other, each once, and writes them to one of
 * - .vsm: all point and cell arrays become columns; the points that no cell uses, which no piece
 *   has, come along from the .vsm file that the pieces come from, where they were;
 * - .ply, .vtp (triangles), .vtu: one file with all point and cell arrays; how they are called in
 *   PLY, smg::writePly tells;
 * - .sma, .smb (triangles), .sva, .svb (tetrahedra): positions in single precision and cells;
 * - .pvtp, .pvtu: an index and a folder of that name with one file a piece, with the GlobalIds and
 *   ghost arrays that make them legal input of all streaming filters again.
 * What the format does not hold is left out or rounded with a warning. Never more than a piece is
 * in memory (with RestoreOrder 256 MiB at most). The input must keep the piece contract described
 * at vtkStreamingMeshReader, also for piece files: points that no cell uses, or that are not
 * numbered by first use, are refused. A mesh of any other source, whose points have no GlobalIds,
 * is taken whole from memory and gets an order as smg::convert() gives it. The input is always
 * asked for its real pieces, not for previews. The file gets its name when it is complete; after an
 * error or an abort nothing new is left.
 *
 * With more than one process, process 0 writes and the others wait for it.
 *
 * @sa vtkStreamingMeshReader vtkStreamingMeshKeys
 */
#ifndef vtkStreamingMeshWriter_h
#define vtkStreamingMeshWriter_h

#include "vtkStreamingMultigridIOModule.h" // For export macro
#include "vtkWriter.h"

class VTKSTREAMINGMULTIGRIDIO_EXPORT vtkStreamingMeshWriter : public vtkWriter
{
public:
  static vtkStreamingMeshWriter* New();
  vtkTypeMacro(vtkStreamingMeshWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The file to write; its suffix says which format. */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * How many pieces the input is pulled in, 0 to 1,000,000. Default: 0, which is as many as give
   * pieces of about 64,000 cells. (SetNumberOfPieces is what ParaView calls with the number of
   * processes.)
   */
  vtkSetClampMacro(NumberOfStreamedPieces, int, 0, 1000000);
  vtkGetMacro(NumberOfStreamedPieces, int);
  ///@}

  ///@{
  /**
   * Whether vertices and cells go back into the order of the mesh file that the stream was made of,
   * which the arrays OriginalId and OriginalCellId tell: somebody who gave a PLY gets the same PLY
   * back, with points moved. For .ply, .vtp, .vtu, .vtk, .obj, .off, .stl, .mesh, .msh and .ele
   * files; see smg::writeRestored. Takes 256 MiB of memory at most. Default: off.
   */
  vtkSetMacro(RestoreOrder, bool);
  vtkGetMacro(RestoreOrder, bool);
  vtkBooleanMacro(RestoreOrder, bool);
  ///@}

  ///@{
  /**
   * The .vsm file that has the points of no cell. Default: none, which is the one that the input
   * says it comes from, if it says so (see vtkStreamingMeshKeys::STREAM_FILE()): needed for data
   * that came another way.
   */
  vtkSetFilePathMacro(StreamFileName);
  vtkGetFilePathMacro(StreamFileName);
  ///@}

  /** Writes the file. Answers 1, or 0 after an error or an abort. */
  int Write() override;

protected:
  vtkStreamingMeshWriter() = default;
  ~vtkStreamingMeshWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkStreamingMeshWriter(const vtkStreamingMeshWriter&) = delete;
  void operator=(const vtkStreamingMeshWriter&) = delete;

  bool WriteFile();

  char* FileName = nullptr;
  int NumberOfStreamedPieces = 0;
  bool RestoreOrder = false;
  char* StreamFileName = nullptr;
};

#endif
