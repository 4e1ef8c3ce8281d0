// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshWriter
 * @brief   Writes a very large mesh piece by piece
 *
 * Requests the pieces of its input one after the other, each once, and writes them to one file of
 * any format that docs/formats.md says is written, with the arrays that it can hold. In a .vsm file
 * the points that no cell uses, which no piece has, are copied from the .vsm file of the pieces; a
 * .pvtp or .pvtu file is an index of a folder of that name with one file per piece, with the
 * GlobalIds and ghost arrays that make them valid input of all streaming filters.
 *
 * Data that the format cannot hold are omitted or rounded with a warning. At most one piece is in
 * memory (with RestoreOrder at most 256 MiB). The input must fulfil the piece contract described at
 * vtkStreamingMeshReader, also for piece files: points that no cell uses, or that are not numbered
 * by first use, are rejected. A mesh of any other source, whose points have no GlobalIds, is taken
 * from memory as a whole and sorted as by smg::convert(); in formats that are restored and have no
 * place for the array OriginalId, in its own order. The writer always requests real pieces, not
 * previews. The file is renamed when it is complete; after an error or an abort no new file is
 * left.
 *
 * The shortest paths of vtkStreamingDistance are written as .vtp, .vtk or .obj, those of the whole
 * mesh. What is made of a preview and is no piece of a mesh, as a table, is an error.
 *
 * With several processes, process 0 writes and the others wait for it.
 *
 * @sa vtkStreamingMeshReader vtkStreamingMeshKeys
 */
#ifndef vtkStreamingMeshWriter_h
#define vtkStreamingMeshWriter_h

#include "StreamingMeshProperties.h"
#include "vtkStreamingMultigridIOModule.h" // For export macro
#include "vtkWriter.h"

#include <memory> // For std::unique_ptr

class VTKSTREAMINGMULTIGRIDIO_EXPORT vtkStreamingMeshWriter : public vtkWriter
{
public:
  static vtkStreamingMeshWriter* New();
  vtkTypeMacro(vtkStreamingMeshWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The file to write; its suffix selects the format. */
  smgFileProperty(FileName);

  /** The number of pieces in which the input is requested, 0 to 1,000,000. Default: 0 (pieces of
   * about 4 MiB). (ParaView calls SetNumberOfPieces with the number of processes.) */
  smgProperty(NumberOfStreamedPieces, int);

  /**
   * Whether to restore the order of vertices and cells of the original mesh file, according to the
   * arrays OriginalId and OriginalCellId: a PLY file is written as the same PLY file with moved
   * points. A mesh of any other source is written in its own order, without these arrays. For
   * formats that docs/formats.md says are restored. Takes at most 256 MiB of memory. Default: off.
   */
  smgFlagProperty(RestoreOrder);

  /** Whether to write text where the format has a binary and a text form. Numbers read back
   * exactly. Formats of binary files are an error. Default: off. */
  smgFlagProperty(WriteText);

  /** The .vsm file with the points of no cell. Default: none (the file in
   * vtkStreamingMeshKeys::STREAM_FILE() of the input, if any). Required only for other data. */
  smgFileProperty(StreamFileName);

  ///@{
  /** Whether to write only the arrays that are named by AddPointArray() and AddCellArray().
   * Default: off, all arrays. */
  smgFlagProperty(ChooseArraysToWrite);
  void AddPointArray(const char* name);
  void AddCellArray(const char* name);
  void RemoveAllPointArrays();
  void RemoveAllCellArrays();
  ///@}

  /**
   * Writes the file. Returns 1, or 0 after an error or an abort. GetErrorCode() tells what kind of
   * error it was: NoFileNameError, UnrecognizedFileTypeError (the suffix), CannotOpenFileError (no
   * file can be made there), OutOfDiskSpaceError, UserError (an abort), UnknownError.
   */
  int Write() override;

protected:
  vtkStreamingMeshWriter();
  ~vtkStreamingMeshWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkStreamingMeshWriter(const vtkStreamingMeshWriter&) = delete;
  void operator=(const vtkStreamingMeshWriter&) = delete;

  struct Internals;

  void WriteFile();

  std::string FileName;
  int NumberOfStreamedPieces = 0;
  bool RestoreOrder = false;
  bool WriteText = false;
  std::string StreamFileName;
  bool ChooseArraysToWrite = false;
  std::unique_ptr<Internals> Internal;
};

#endif
