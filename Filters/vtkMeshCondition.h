// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshCondition
 * @brief   Says what holds in a region of a gigantic mesh: a condition of an elliptic problem
 *
 * Prescribes a value, or says the flux through the boundary, the exchange with the surroundings, a
 * source, a conductivity, a screening or a soft constraint, where the Region is. Filters are
 * chained, one for each condition, and vtkStreamingPoisson behind them solves. Of conditions of one
 * kind that hold at the same place the last one counts; soft ones add up.
 *
 * Beside the regions of vtkMeshRegion there are those by TAG: where the array TagArray of the
 * points or the cells has the value Tag; and EVERYWHERE. Cells, and facets of the boundary, are in
 * a region if all their corners are; a tag of the cells holds in these cells, at their points and
 * on their facets. Fluxes and the exchange of ROBIN are those of boundary facets alone: open edges
 * of a surface, faces of one tetrahedron.
 *
 * The output is the input with the condition in the field array `MeshConditions`, in the words of
 * `smg solve --problem`, and the point array `Condition1`, `Condition2` ... (unsigned char, by the
 * place in the chain) which is 1 where it holds, the active scalars of the output; there is no such
 * array for TAG, nor for a source, a conductivity or a screening EVERYWHERE, and NumberOfHeldPoints
 * is 0 then. vtkStreamingPoisson takes the conditions and their arrays away.
 *
 * @sa vtkMeshRegion vtkStreamingPoisson
 */
#ifndef vtkMeshCondition_h
#define vtkMeshCondition_h

#include "vtkMeshRegion.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkMeshCondition : public vtkMeshRegion
{
public:
  static vtkMeshCondition* New();
  vtkTypeMacro(vtkMeshCondition, vtkMeshRegion);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** What says where the condition holds, beside RegionTypes. */
  enum MoreRegionTypes
  {
    TAG = 4,
    EVERYWHERE = 5
  };

  /** What the condition says, u being the solution, n the outward normal. */
  enum ConditionTypes
  {
    DIRICHLET = 0,    ///< u = Value
    FLUX = 1,         ///< (K grad u - q) . n = Value, positive into the body
    ROBIN = 2,        ///< (K grad u - q) . n = Coefficient * (Value - u), Value: the surroundings'
    SOURCE = 3,       ///< f = Value, a density
    CONDUCTIVITY = 4, ///< K = Value: 1 number, 3 (xx, yy, zz) or 6 (xx, yy, zz, xy, yz, xz)
    SCREENING = 5,    ///< s = Value, at least 0
    SOFT = 6          ///< adds Coefficient * (u - Value), a density, to the equations
  };

  /** What says where the condition holds: a RegionTypes, TAG or EVERYWHERE. Default: FUNCTION. */
  void SetRegion(int region) override;

  ///@{
  /** Name of the array of points or cells of TAG, and the value it has in the region. Default:
   * none, 0. */
  vtkSetStringMacro(TagArray);
  vtkGetStringMacro(TagArray);
  vtkSetMacro(Tag, double);
  vtkGetMacro(Tag, double);
  ///@}

  ///@{
  /** What the condition says. Default: DIRICHLET. */
  vtkSetClampMacro(Condition, int, DIRICHLET, SOFT);
  vtkGetMacro(Condition, int);
  ///@}

  ///@{
  /** The value, where one number is enough: with one right-hand side. Default: 0. */
  vtkSetMacro(Value, double);
  vtkGetMacro(Value, double);
  ///@}

  ///@{
  /** The numbers of the value, one for each right-hand side, or those of a tensor; if there are
   * any, they count instead of Value. Default: none. */
  void AddValue(double value);
  void RemoveAllValues();
  int GetNumberOfValues();
  ///@}

  ///@{
  /** Whether the value is the point's own position, for three right-hand sides. Default: off. */
  vtkSetMacro(ValueIsPosition, bool);
  vtkGetMacro(ValueIsPosition, bool);
  vtkBooleanMacro(ValueIsPosition, bool);
  ///@}

  ///@{
  /** The coefficient of ROBIN, the weight of SOFT; at least 0. Default: 1. */
  vtkSetMacro(Coefficient, double);
  vtkGetMacro(Coefficient, double);
  ///@}

protected:
  vtkMeshCondition();
  ~vtkMeshCondition() override;

  void Check() override;
  bool IsElsewhere() override { return this->Region == TAG || this->Region == EVERYWHERE; }
  void Deliver(vtkPointSet& piece, const smg::HeldPoints& held, vtkPointSet& output) override;

private:
  vtkMeshCondition(const vtkMeshCondition&) = delete;
  void operator=(const vtkMeshCondition&) = delete;

  struct Internals;

  char* TagArray = nullptr;
  double Tag = 0.0;
  int Condition = DIRICHLET;
  double Value = 0.0;
  bool ValueIsPosition = false;
  double Coefficient = 1.0;

  std::unique_ptr<Internals> Internal;
};

#endif
