// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshRegion
 * @brief   What the filters that say something of a region of a gigantic mesh have in common
 *
 * What is held, by Region:
 * - FUNCTION: the points where RegionFunction is at most 0 (with InsideOut: at least 0);
 * - SELECTION: the points, or the cells' points, of the selection at input port 1;
 * - IDS: the points with the given Ids, which are GlobalIds (stream indices) or values of the
 *   array `OriginalId`;
 * - POINTS: the points nearest to the given places.
 *
 * A selection of points by GlobalIds is the same as these Ids: it names points of the mesh, on the
 * preview, too. Any other selection is made on what is displayed. Of a gigantic mesh that is the
 * preview (see vtkStreamingMeshReader), as soon as real pieces are asked for its points are
 * projected to the nearest points of the mesh, in one pass over NumberOfPieces pieces of the input,
 * with all points within Radius and Rings of these; so are places, and ids that have a Radius or
 * Rings. What was found is kept until the region or the mesh is modified: filters of this kind
 * before this one can be changed, unless the selection is one by values of arrays. A point that is
 * farther from the mesh than 1 % of the diagonal of its bounds gives a warning. On a preview, Rings
 * mean nothing, and ids and places hold the nearest points of the preview.
 *
 * A region that holds nothing is an error as soon as that is known: when the whole mesh is asked
 * for, or at the last piece when streamed pieces are asked for in order. If it is a preview that
 * has no point in the region, that is a warning, as the mesh may have some.
 *
 * With more than one process, selections by point numbers hold points of the process that they name
 * as long as each asks for its own piece; streamed requests need GlobalIds, unless a preview is
 * displayed.
 *
 * @sa vtkMeshHandle vtkMeshCondition vtkStreamingMeshReader
 */
#ifndef vtkMeshRegion_h
#define vtkMeshRegion_h

#include "vtkPassInputTypeAlgorithm.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr

class vtkImplicitFunction;
class vtkPointSet;

namespace smg
{
struct HeldPoints;
}

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkMeshRegion : public vtkPassInputTypeAlgorithm
{
public:
  vtkTypeMacro(vtkMeshRegion, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** What says which points are held. */
  enum RegionTypes
  {
    FUNCTION = 0,
    SELECTION = 1,
    IDS = 2,
    POINTS = 3
  };

  /** What the Ids are. */
  enum IdTypes
  {
    GLOBAL_IDS = 0,  ///< GlobalIds, which number the points in the order of the stream
    ORIGINAL_IDS = 1 ///< values of the point array `OriginalId`: numbers in the original file
  };

  ///@{
  /** What says which points are held. Default: FUNCTION. */
  vtkSetClampMacro(Region, int, FUNCTION, POINTS);
  vtkGetMacro(Region, int);
  ///@}

  ///@{
  /**
   * The function that is at most 0 where points are held; it must be finite at every point, and the
   * radius of a vtkSphere or vtkCylinder greater than 0. Default: none.
   */
  virtual void SetRegionFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetRegionFunction() { return this->RegionFunction; }
  ///@}

  ///@{
  /** Whether the points are held where the function is at least 0 instead. Default: off. */
  vtkSetMacro(InsideOut, bool);
  vtkGetMacro(InsideOut, bool);
  vtkBooleanMacro(InsideOut, bool);
  ///@}

  /** Connects what makes the selection (a vtkSelection): input port 1. */
  void SetSelectionConnection(vtkAlgorithmOutput* selection);

  ///@{
  /** The ids of the points that are held, at least 0. Default: none. */
  void AddId(vtkIdType id);
  void RemoveAllIds();
  vtkIdType GetNumberOfIds();
  vtkIdType GetId(vtkIdType i);
  ///@}

  ///@{
  /** What the ids are. Default: GLOBAL_IDS. */
  vtkSetClampMacro(IdType, int, GLOBAL_IDS, ORIGINAL_IDS);
  vtkGetMacro(IdType, int);
  ///@}

  ///@{
  /** The places whose nearest points are held. Default: none. */
  void AddPoint(double x, double y, double z);
  void RemoveAllPoints();
  vtkIdType GetNumberOfPoints();
  ///@}

  ///@{
  /**
   * How far around the points of a selection, of ids or of places the mesh is held: the distance
   * from each. 0: only the points themselves. Below 0 (default -1): for points selected on a
   * preview as far as each of them stands for the mesh around it, which is the mean length of the
   * preview's edges divided by the square root of 3; else 0.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * The same, counted in edges of the mesh, 0 to 100; what is within the radius or the rings is
   * held. Default: 0.
   */
  vtkSetClampMacro(Rings, int, 0, 100);
  vtkGetMacro(Rings, int);
  ///@}

  ///@{
  /**
   * How many pieces the input is pulled in where points are projected, 1 to 1,000,000. Default: 64.
   * What is held does not depend on it.
   */
  vtkSetClampMacro(NumberOfPieces, int, 1, 1000000);
  vtkGetMacro(NumberOfPieces, int);
  ///@}

  /**
   * How many points of the last answer this filter holds; of streamed pieces asked for in order, of
   * all of them since the first. Points that an earlier piece owns do not count. 0 after an error.
   */
  vtkGetMacro(NumberOfHeldPoints, vtkIdType);

  /** Also the time of the function. */
  vtkMTimeType GetMTime() override;

protected:
  vtkMeshRegion();
  ~vtkMeshRegion() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /** Throws smg::Error if a property of the subclass is wrong, before the input is asked for. */
  virtual void Check() = 0;

  /** Whether the region needs no held points: then `held` has none. Default: no. */
  virtual bool IsElsewhere() { return false; }

  /** Gives the output the piece and what is said of its held points. Throws smg::Error. */
  virtual void Deliver(vtkPointSet& piece, const smg::HeldPoints& held, vtkPointSet& output) = 0;

  int Region = FUNCTION;

private:
  vtkMeshRegion(const vtkMeshRegion&) = delete;
  void operator=(const vtkMeshRegion&) = delete;

  vtkImplicitFunction* RegionFunction = nullptr;
  bool InsideOut = false;
  int IdType = GLOBAL_IDS;
  double Radius = -1.0;
  int Rings = 0;
  int NumberOfPieces = 64;
  vtkIdType NumberOfHeldPoints = 0;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
