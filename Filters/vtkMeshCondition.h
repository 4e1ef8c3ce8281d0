// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshCondition
 * @brief   Sets a condition of an elliptic problem in a region of a very large mesh
 *
 * Prescribes a value, the flux through the boundary, the exchange with the surroundings, a source,
 * a conductivity, a screening or a soft constraint in the Region. Filters are chained, one for each
 * condition, followed by vtkStreamingPoisson, which solves. Of several conditions of one kind at
 * the same place the last one counts; soft ones add up.
 *
 * vtkRegionFilter describes the regions. Cells and boundary facets are in a region if all their
 * corners are; a mask or tag of cells applies to these cells, their points and their facets. FLUX
 * and ROBIN apply to boundary facets only: open edges of a surface, faces of one tetrahedron.
 *
 * The output is the input with the condition in the field array `MeshConditions`, in the JSON of
 * `smg solve --problem`, and the point array `Condition1`, `Condition2` ... (unsigned char, by the
 * position in the chain), which is 1 in the region and the active scalars of the output. The solver
 * itself evaluates BOUNDARY, MASK, TAG, GROUP, and a source, a conductivity or a screening
 * EVERYWHERE: then this array is absent, and NumberOfHeldPoints is 0; that of GROUP is there where
 * the mesh is not streamed, for views. vtkStreamingPoisson removes the conditions and their arrays.
 *
 * @sa vtkRegionFilter vtkStreamingPoisson
 */
#ifndef vtkMeshCondition_h
#define vtkMeshCondition_h

#include "vtkRegionFilter.h"
#include "vtkStreamingMultigridFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkMeshCondition : public vtkRegionFilter
{
public:
  static vtkMeshCondition* New();
  vtkTypeMacro(vtkMeshCondition, vtkRegionFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Types of conditions; u is the solution, n the outward normal. */
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

  /** The type of the condition. Default: DIRICHLET. */
  smgProperty(Condition, int);

  /** The value, if it is a single number: with one right-hand side. Default: 0. */
  smgProperty(Value, double);

  ///@{
  /** The components of the value, one per right-hand side, or those of a tensor; if there are any,
   * they replace Value. Default: none. */
  void AddValue(double value);
  void RemoveAllValues();
  int GetNumberOfValues();
  ///@}

  /** Whether the value is the position of the point, for three right-hand sides. Default: off. */
  smgFlagProperty(ValueIsPosition);

  /** The coefficient of ROBIN, the weight of SOFT; at least 0. Default: 1. */
  smgProperty(Coefficient, double);

protected:
  vtkMeshCondition();
  ~vtkMeshCondition() override;

  void Check() override;
  std::string UnusedProperty() override;
  bool IsEvaluatedBySolver() override;
  void Deliver(vtkPointSet& piece, const smg::HeldPoints& held, vtkPointSet& output) override;

private:
  vtkMeshCondition(const vtkMeshCondition&) = delete;
  void operator=(const vtkMeshCondition&) = delete;

  struct Internals;

  int Condition = DIRICHLET;
  double Value = 0.0;
  bool ValueIsPosition = false;
  double Coefficient = 1.0;

  std::unique_ptr<Internals> Internal;
};

#endif
