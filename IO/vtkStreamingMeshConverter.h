// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshConverter
 * @brief   Converts a mesh file to a stream, keeps it, and delivers its pieces
 *
 * Brings a mesh file of any format that can be read (PLY, OBJ, OFF, STL, Medit, Gmsh, TetGen,
 * legacy VTK, .vtp, .vtu, .pvtp, .pvtu, VTKHDF, SMA, SMB, SVA, SVB, .vsm, also .gz) into a stream
 * order and writes it to the container OutputFileName, which stays. FileName is the mesh file;
 * otherwise this is a vtkStreamingMeshReader of that container: see there for its pieces, its
 * arrays, and the preview that it shows of a mesh that is too large. ScratchDirectory is for the
 * scratch files of the conversion.
 *
 * vtkStreamingMeshReader itself reads such files, too, but converts them to a temporary container,
 * again for every reader. Use this class where a mesh is to be opened more than once.
 *
 * The conversion takes place when the pipeline first asks for anything. It is not repeated as long
 * as FileName, Order, Cells, Weld, TimeStep and Partition stay what they are, and FileName as it
 * is: the container says what it was made from, so that it is used again in later sessions, too.
 * When something of that changes, the container is made anew. A file of the name OutputFileName
 * that is no conversion of FileName is left alone, which is an error, unless Overwrite is on. With
 * several processes one converts, the others wait; FileName and OutputFileName must then be seen by
 * all.
 *
 * The conversion works out of core: it needs no more memory than MemoryLimit, and room for scratch
 * files in ScratchDirectory of about five times the size of the mesh in memory.
 *
 * @sa vtkStreamingMeshReader vtkStreamingMeshWriter
 */
#ifndef vtkStreamingMeshConverter_h
#define vtkStreamingMeshConverter_h

#include "vtkStreamingMeshReader.h"
#include "vtkStreamingMultigridIOModule.h" // For export macro

#include <string> // For std::string

class VTKSTREAMINGMULTIGRIDIO_EXPORT vtkStreamingMeshConverter : public vtkStreamingMeshReader
{
public:
  static vtkStreamingMeshConverter* New();
  vtkTypeMacro(vtkStreamingMeshConverter, vtkStreamingMeshReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The orders that a mesh can be brought into. */
  enum OrderTypes
  {
    BREADTH_FIRST = 0, ///< from planned starts, component after component
    AXIS = 1,          ///< along the longest side of the bounds
    KEEP = 2,          ///< the order of the cells in the file
    SPECTRAL = 3       ///< along the Fiedler vector: the smallest width
  };

  ///@{
  /** The container to write, a name that ends in .vsm. Default: none; it must be said. */
  vtkSetFilePathMacro(OutputFileName);
  vtkGetFilePathMacro(OutputFileName);
  ///@}

  ///@{
  /** The order of the stream. Default: BREADTH_FIRST, which suits nearly every mesh. */
  vtkSetClampMacro(Order, int, BREADTH_FIRST, SPECTRAL);
  vtkGetMacro(Order, int);
  ///@}

  /** The cells of a file that has both surface cells and volume cells. */
  enum CellTypes
  {
    ONLY = 0,      ///< a file that has both is an error
    TRIANGLES = 1, ///< volume cells are left out
    TETRAHEDRA = 2 ///< surface cells are left out
  };

  ///@{
  /** Which cells of a file to keep. Default: ONLY. */
  vtkSetClampMacro(Cells, int, ONLY, TETRAHEDRA);
  vtkGetMacro(Cells, int);
  ///@}

  ///@{
  /** Whether to merge points that lie within WeldDistance of each other. Default: off. */
  vtkSetMacro(Weld, bool);
  vtkGetMacro(Weld, bool);
  vtkBooleanMacro(Weld, bool);
  ///@}

  ///@{
  /**
   * Points are merged within this distance, in units of the coordinates. Default: 0, which merges
   * points of equal coordinates.
   */
  vtkSetClampMacro(WeldDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(WeldDistance, double);
  ///@}

  ///@{
  /** Which time step to read of a file that has some (VTKHDF), from 0. Default: 0. */
  vtkSetClampMacro(TimeStep, int, 0, VTK_INT_MAX);
  vtkGetMacro(TimeStep, int);
  ///@}

  ///@{
  /**
   * Which partition to read of a file that has some (VTKHDF), from 0. Default: -1, which is all of
   * them, joined.
   */
  vtkSetClampMacro(Partition, int, -1, VTK_INT_MAX);
  vtkGetMacro(Partition, int);
  ///@}

  ///@{
  /** Whether OutputFileName may replace a file that is no conversion of FileName. Default: off. */
  vtkSetMacro(Overwrite, bool);
  vtkGetMacro(Overwrite, bool);
  vtkBooleanMacro(Overwrite, bool);
  ///@}

  ///@{
  /**
   * Memory that the conversion may use, in MiB, at least 16, whatever the size of the mesh.
   * Default: 0, which is 256.
   */
  vtkSetClampMacro(MemoryLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

  /**
   * Whether the file is a mesh of a format that is no stream. One of a format that VTK reads must
   * have, or by its size seem to have, more points than MaximumPointsInMemory: smaller ones are
   * left to VTK's readers. So ParaView's File > Open offers the converter beside these.
   */
  int CanReadFile(const char* name);

  /**
   * What FileName seems to hold, and what memory a reader that reads all of it would take, in a
   * line. Empty if it is no mesh that can be converted.
   */
  const char* GetEstimate();

  /**
   * The report of the conversion to OutputFileName, as JSON. Empty if this object has made none,
   * since the container was up to date.
   */
  const char* GetReport();

protected:
  vtkStreamingMeshConverter();
  ~vtkStreamingMeshConverter() override;

  std::string GetContainerName() override;
  void UpdateContainer() override;

private:
  vtkStreamingMeshConverter(const vtkStreamingMeshConverter&) = delete;
  void operator=(const vtkStreamingMeshConverter&) = delete;

  char* OutputFileName = nullptr;
  int Order = BREADTH_FIRST;
  int Cells = ONLY;
  bool Weld = false;
  double WeldDistance = 0.0;
  int TimeStep = 0;
  int Partition = -1;
  bool Overwrite = false;
  int MemoryLimit = 0;
  std::string Report, Estimate;
  std::string ReportedName; ///< of the container that the report is about
};

#endif
