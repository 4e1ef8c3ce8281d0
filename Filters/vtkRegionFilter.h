// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRegionFilter
 * @brief   Base class of filters that act on a region of a very large mesh
 *
 * The points that Region selects (the held points):
 * - FUNCTION: the points where RegionFunction is at most 0 (with InsideOut: above 0);
 * - SELECTION: the points, or the points of the cells, of the selection at input port 1;
 * - IDS: the points with the given Ids, which are GlobalIds (stream indices; of a mesh without
 *   them the numbers of its points, from 0) or values of the array `OriginalId`;
 * - POINTS: the points nearest to the given positions;
 * - BOUNDARY: the points on boundary edges of a surface (those of exactly one triangle), or on
 *   boundary faces of a solid (those of exactly one cell);
 * - MASK: the points where MaskArray is not 0, or those of the cells where it is not 0;
 * - GROUP: the points of a group that the mesher has named, of its facets or of its cells;
 * - TAG: the points where TagArray has the value Tag, or those of the cells where it has;
 * - EVERYWHERE: all points.
 *
 * A selection of points by GlobalIds is equivalent to IDS: it refers to points of the mesh, also on
 * the preview. Any other selection refers to the displayed data. For a very large mesh this is the
 * preview (see vtkStreamingMeshReader): when streamed pieces are requested, the selected points are
 * projected to the nearest points of the mesh, in one pass over NumberOfPieces pieces of the input,
 * together with all points within Radius and Rings of these. Positions, and ids with a Radius or
 * Rings, are projected in the same way. The result is kept until the region or the mesh is
 * modified; filters of this kind upstream may change, unless the selection is by array values. A
 * point that is farther from the mesh than 1 % of the diagonal of its bounds causes a warning. On a
 * preview, Rings has no effect, and ids and positions hold the nearest points of the preview.
 *
 * An array of the points is evaluated on each piece. The boundary, and the points of marked cells
 * and of groups, cross pieces: when streamed pieces are requested, they are found in one pass over
 * NumberOfPieces pieces of the input, in a scratch file of one bit a point, and kept until the mesh
 * is modified. The boundary on a preview is that of the preview: its open edges, which follow those
 * of the mesh; of the surface preview of a solid all points. An array of the cells that a preview
 * does not have is evaluated on the mesh, whose points those of the preview are.
 *
 * A property that is set but has no effect while Region is Function causes a warning, one out of
 * its range is an error of the update. An empty region is an error, reported when the whole mesh is
 * requested, or at the last piece when streamed pieces are requested in order. A preview without a
 * point in the region causes a warning, since the mesh may have some.
 *
 * With several processes, selections by point index refer to the points of the named process as
 * long as each process requests its own piece; streamed requests need GlobalIds, unless a preview
 * is displayed. The boundary and marked cells of a mesh in pieces need them, too.
 *
 * @sa vtkMeshRegion vtkMeshHandle vtkMeshCondition vtkStreamingMeshReader
 */
#ifndef vtkRegionFilter_h
#define vtkRegionFilter_h

#include "StreamingMeshProperties.h"
#include "vtkPassInputTypeAlgorithm.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkImplicitFunction;
class vtkPointSet;
class vtkStringArray;

namespace smg
{
struct HeldPoints;
}

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkRegionFilter : public vtkPassInputTypeAlgorithm
{
public:
  vtkTypeMacro(vtkRegionFilter, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The types of regions. */
  enum RegionTypes
  {
    FUNCTION = 0,
    SELECTION = 1,
    IDS = 2,
    POINTS = 3,
    TAG = 4,
    EVERYWHERE = 5,
    BOUNDARY = 6,
    MASK = 7,
    GROUP = 8
  };

  /** The meaning of Ids. */
  enum IdTypes
  {
    GLOBAL_IDS = 0,  ///< GlobalIds: indices in the stream
    ORIGINAL_IDS = 1 ///< values of the point array `OriginalId`: indices in the original file
  };

  /** The type of the region. Default: FUNCTION. */
  smgProperty(Region, int);

  ///@{
  /** The implicit function that is at most 0 at held points. It must be finite at every point; the
   * radius of a vtkSphere or vtkCylinder must be greater than 0. Default: none. */
  virtual void SetRegionFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetRegionFunction() { return this->RegionFunction; }
  ///@}

  /** Whether to hold the points where the function is above 0 instead. Default: off. */
  smgFlagProperty(InsideOut);

  /** Connects the source of the selection (a vtkSelection) to input port 1. */
  void SetSelectionConnection(vtkAlgorithmOutput* selection);

  ///@{
  /** The ids of the held points, at least 0. Default: none. */
  void AddId(vtkIdType id);
  void RemoveAllIds();
  vtkIdType GetNumberOfIds();
  vtkIdType GetId(vtkIdType i);
  ///@}

  /** The meaning of the ids. Default: GLOBAL_IDS. */
  smgProperty(IdType, int);

  ///@{
  /** The positions whose nearest points are held. Default: none. */
  void AddPoint(double x, double y, double z);
  void RemoveAllPoints();
  vtkIdType GetNumberOfPoints();
  ///@}

  /**
   * The distance from the points of a selection, of ids or of positions within which the mesh is
   * held. 0: only the points themselves. -1 (default): for points selected on a preview,
   * the mean edge length of the preview divided by the square root of 3, the radius that each of
   * them represents; otherwise 0.
   */
  smgProperty(Radius, double);

  /** The distance in edges of the mesh, 0 to 100; points within the radius or the rings are held.
   * Default: 0. */
  smgProperty(Rings, int);

  /** The name of the array of points or cells of MASK, with one component; points take precedence.
   * Default: none. */
  smgTextProperty(MaskArray);

  ///@{
  /** The same of TAG, and its value in the region. Default: none, 0. */
  smgTextProperty(TagArray);
  smgProperty(Tag, double);
  ///@}

  /** The name of the group of GROUP, or its number; * stands for any characters. GetGroupNames()
   * has those of the input. Default: none. */
  smgTextProperty(GroupName);
  /** The groups of the mesh that the input delivered last. */
  vtkStringArray* GetGroupNames();

  /** The number of pieces in which the input is requested to search it, 0 to 1,000,000. Default: 0
   * (at least 64, and pieces of at most 64 MiB). The held points do not depend on it. */
  smgProperty(NumberOfPieces, int);

  /** The number of held points in the last output; for streamed pieces requested in order, in all
   * pieces since the first. Points owned by an earlier piece do not count. 0 after an error. */
  vtkGetMacro(NumberOfHeldPoints, vtkIdType);

  /** The bounds (xmin, xmax, ymin ...) of these points; if there are none, those of what the input
   * delivered last; 0 if that has no points either. */
  double* GetHeldBounds() VTK_SIZEHINT(6);

  /** What the last request found, in a sentence: the number of held points, or why it failed. */
  const char* GetOutcome();

  /** The reason why the last request failed, of this filter or of one before it; "": it did not. */
  const char* GetError();

  /** Includes the modification time of the function. */
  vtkMTimeType GetMTime() override;

protected:
  vtkRegionFilter();
  ~vtkRegionFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /** Throws smg::Error if a property of the subclass is invalid; called before the input is
   * updated. */
  virtual void Check() = 0;

  /** A sentence about a property that is set but has no effect with the others, for a warning; ""
   * if there is none. */
  virtual std::string UnusedProperty();

  /** Whether the data are assigned without held points; `held` is then empty, unless they are those
   * of a group that is shown. Default: false. */
  virtual bool IsEvaluatedBySolver() { return false; }

  /** Fills the output with the piece and the data of its held points. Throws smg::Error. */
  virtual void Deliver(vtkPointSet& piece, const smg::HeldPoints& held, vtkPointSet& output) = 0;

  /** Warns, once, that Deliver() has replaced an array of the input; "": it has not. */
  void WarnOfReplaced(const std::string& sentence);

  /** The name of the array of MASK or TAG. Throws smg::Error if there is none. */
  std::string RegionArray() const;
  /** The same of GROUP. */
  std::string RegionGroup() const;

  int Region = FUNCTION;

private:
  vtkRegionFilter(const vtkRegionFilter&) = delete;
  void operator=(const vtkRegionFilter&) = delete;

  vtkImplicitFunction* RegionFunction = nullptr;
  bool InsideOut = false;
  int IdType = GLOBAL_IDS;
  double Radius = -1.0;
  int Rings = 0;
  std::string MaskArray;
  std::string TagArray;
  double Tag = 0.0;
  std::string GroupName;
  int NumberOfPieces = 0;
  vtkIdType NumberOfHeldPoints = 0;
  double HeldBounds[6] = {};

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
