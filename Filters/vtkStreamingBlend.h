// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamingBlend
 * @brief   Removes the steps of point arrays between the patches of a very large mesh
 *
 * Blends point arrays that were recorded in patches with different gains and offsets, in the
 * gradient domain: the steps between patches vanish, the gradients inside them stay. The output is
 * the input with these arrays, in their types; all else is kept.
 *
 * - For streamed requests (see vtkStreamingMeshKeys), those of writers and other streaming filters,
 *   the whole mesh is blended once, out of core, as described at vtkStreamingSolver.
 * - For other requests, if the input is a preview and Solve says so, the preview itself is blended
 *   in memory.
 *
 * Weights has no effect: those of finite elements are used.
 *
 * @sa vtkStreamingSolver vtkStreamingPoisson vtkStreamingMeshReader
 */
#ifndef vtkStreamingBlend_h
#define vtkStreamingBlend_h

#include "vtkStreamingMultigridFiltersModule.h" // For export macro
#include "vtkStreamingSolver.h"

class VTKSTREAMINGMULTIGRIDFILTERS_EXPORT vtkStreamingBlend : public vtkStreamingSolver
{
public:
  static vtkStreamingBlend* New();
  vtkTypeMacro(vtkStreamingBlend, vtkStreamingSolver);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Name of the array of one component with the patch of each point, or of each cell: points of
   * cells of several patches then are in no patch. That of the points counts if both have it. */
  smgTextOption(Patch);

  /** Names of the point arrays to blend, with at most 64 components together. Default: none. */
  smgNamesProperty(Array);

  /** The former name of these, which counts if there are none. */
  smgNamesProperty(Column);

  /** The parts that keep their values, besides what vtkMeshRegion marks: WHERE of a problem file in
   * JSON, or a list of these, for example {"sphere": [0, 0, 0, 1]}. Columns are arrays of the
   * input. Default: none. */
  smgTextOption(Hold);

  /** How strongly all values are pulled towards the original ones, at least 0: corrections over
   * less than 1 / sqrt(Anchor) diagonals of the bounds are hardly pulled. Default: 0.01. */
  smgOption(Anchor, double);

  /** The gradients between patches. */
  enum SeamGradientType
  {
    ZERO,   ///< 0: the steps vanish as far as possible
    AVERAGE ///< the mean of the gradients on both sides
  };
  /** The gradients between patches. Default: ZERO. */
  smgOption(SeamGradient, int);

protected:
  vtkStreamingBlend();
  ~vtkStreamingBlend() override;

  std::unique_ptr<smg::JobTask> MakeTask(vtkPointSet& input) override;
  void Deliver(vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output) override;

private:
  vtkStreamingBlend(const vtkStreamingBlend&) = delete;
  void operator=(const vtkStreamingBlend&) = delete;

  const std::vector<std::string>& ChosenArrays() const;

  std::vector<std::string> Arrays, Columns;
};

#endif
