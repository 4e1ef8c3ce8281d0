// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

class vtkPointSet;
class vtkSelection;

namespace smg
{

/** What a selection by numbers of points or cells has selected on the mesh that was shown. Numbers
 * mean nothing on another preview of the mesh, or on all of it. */
class KeptSelection
{
public:
  /** Whether the same selection is kept of the same mesh, shown as another preview, or one of the
   * two times as a whole. */
  bool isOfAnother(vtkPointSet& shown, vtkSelection& selection) const;

  /** Keeps what the selection selects on the mesh that is shown, the points with these numbers. */
  void keep(vtkPointSet& shown, vtkSelection& selection, const std::vector<std::int64_t>& points);

  /** The positions of the selected points, x, y, z of each. */
  const std::vector<double>& places() const { return this->Places; }
  /** Of points of the whole mesh that have GlobalIds: these; else empty. */
  const std::vector<std::int64_t>& ids() const { return this->Ids; }
  /** The radius around points of a preview that leaves no gap between them; 0 of others. */
  double radius() const { return this->Radius; }

private:
  /** What numbers depend on. */
  struct Shown
  {
    std::int64_t allPoints = 0, allCells = 0; ///< of the mesh
    std::int64_t points = 0;
    bool isPreview = false;
    bool operator==(const Shown&) const = default;
  };
  static Shown of(vtkPointSet& mesh);

  std::string Content; ///< of the selection; empty: none is kept
  Shown On;
  std::vector<double> Places;
  std::vector<std::int64_t> Ids;
  double Radius = 0.0;
};

} // namespace smg
