// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingMeshConverter
 * @brief   Converts a mesh file to a stream, keeps it, and delivers its pieces
 *
 * Converts a mesh file of any format that docs/formats.md says is read to a stream order and writes
 * it to the container OutputFileName, which is kept. FileName is the mesh file; apart from that,
 * this is a vtkStreamingMeshReader of the container: see there for pieces, arrays, and the preview
 * of large meshes. ScratchDirectory is the folder for the scratch files of the conversion.
 *
 * vtkStreamingMeshReader also reads such files, but each reader converts them to a temporary
 * container. Use this class if a mesh is opened more than once.
 *
 * The conversion is executed on the first request of the pipeline. It is repeated only if FileName,
 * its file, Order, Cells, Weld, TimeStep or Partition has changed: the container records its
 * source, so that it is also reused in later sessions. If OutputFileName exists and is not a
 * conversion of FileName, the request fails and the file is kept, unless Overwrite is on. With
 * several processes, one converts and the others wait; FileName and OutputFileName must then be
 * accessible to all.
 *
 * The conversion works out of core: it stays within MemoryLimit and needs space for scratch files
 * in ScratchDirectory of about five times the size of the mesh in memory.
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

  /** The stream orders. */
  enum OrderTypes
  {
    BREADTH_FIRST = 0, ///< from chosen starting vertices, component by component
    AXIS = 1,          ///< along the longest side of the bounds
    KEEP = 2,          ///< the order of the cells in the file
    SPECTRAL = 3       ///< along the Fiedler vector: the smallest width
  };

  /** The container to write, with the suffix .vsm. Default: none; it is required. */
  smgFileProperty(OutputFileName);

  /** The order of the stream. Default: BREADTH_FIRST, which suits nearly every mesh. */
  smgProperty(Order, int);

  /** The cells of a file that has both surface cells and volume cells. */
  enum CellTypes
  {
    ONLY = 0,      ///< a file with both is an error
    TRIANGLES = 1, ///< volume cells are omitted
    TETRAHEDRA = 2 ///< surface cells are omitted
  };

  /** The cells of a file to keep. Default: ONLY. */
  smgProperty(Cells, int);

  /** Whether to merge points that lie within WeldDistance of each other. Default: off. */
  smgFlagProperty(Weld);

  /** Points within this distance, in units of the coordinates, are merged. Default: 0 (points of
   * equal coordinates). */
  smgProperty(WeldDistance, double);

  /** Whether to turn triangles so that those of a body are wound alike, and outwards if it is
   * closed. Default: off. */
  smgFlagProperty(Orient);

  /** Which time step of a file with time steps (VTKHDF) to read, from 0. Default: 0. */
  smgProperty(TimeStep, int);

  /**
   * Which partition of a file with partitions (VTKHDF) to read, from 0. Default: -1, all of them,
   * joined.
   */
  smgProperty(Partition, int);

  /**
   * Whether OutputFileName may replace a file that is not a conversion of FileName. Default: off.
   */
  smgFlagProperty(Overwrite);

  /** The memory limit of the conversion in MiB, at least 16, for any size of the mesh. Default: 0,
   * which is 256. */
  smgProperty(MemoryLimit, int);

  /**
   * Whether the file is a mesh of a format that is not a stream. If VTK can read the format, the
   * file must also have more points than MaximumPointsInMemory, according to its header or its
   * size: smaller ones are left to the VTK readers. ParaView's File > Open therefore offers the
   * converter in addition to these.
   */
  int CanReadFile(const char* name);

  /** The size of FileName, estimated until it is converted, and the memory that reading the whole
   * file would take, in one line; or when it is known. */
  const char* GetEstimate();

  /** The report of the conversion to OutputFileName, as JSON. Empty if this object has not
   * converted because the container was up to date. */
  const char* GetReport();

protected:
  vtkStreamingMeshConverter();
  ~vtkStreamingMeshConverter() override;

  std::string GetContainerName() override;
  bool IsContainerMade() override;
  void ChooseConversion(smg::ConversionOptions& options) override;
  void UpdateContainer() override;

private:
  vtkStreamingMeshConverter(const vtkStreamingMeshConverter&) = delete;
  void operator=(const vtkStreamingMeshConverter&) = delete;

  std::string OutputFileName;
  int Order = BREADTH_FIRST;
  int Cells = ONLY;
  bool Weld = false;
  double WeldDistance = 0.0;
  bool Orient = false;
  int TimeStep = 0;
  int Partition = -1;
  bool Overwrite = false;
  int MemoryLimit = 0;
  struct Internals;

  std::string Report, Estimate;
  std::string Warned;       ///< the last warning, which is not repeated
  std::string ReportedName; ///< of the container that the report is about
};

#endif
