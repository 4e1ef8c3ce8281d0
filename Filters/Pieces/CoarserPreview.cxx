// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Pieces/CoarserPreview.h"

#include "Filters/Pieces/CellParts.h"
#include "IO/Results/VertexNormals.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/PieceCells.h"
#include "Solver/Core/DisjointSets.h"
#include "smg/Deform.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"

#include <cstddef>
#include <string_view>
#include <utility>

namespace smg
{
namespace
{

/** A patch of marked points up to this size counts as small. */
constexpr std::int64_t SmallPatch = 64;

/** The number of points of the patch of each point: of the marked points that edges connect. */
std::vector<std::int64_t> patchSizes(
  const std::vector<std::uint8_t>& marked, const std::vector<std::int64_t>& corners)
{
  DisjointSets<std::size_t> patches(marked.size());
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const auto a = static_cast<std::size_t>(corners[k]);
    const auto b = static_cast<std::size_t>(corners[k % 3 == 2 ? k - 2 : k + 1]);
    if (marked[a] && marked[b])
    {
      patches.join(a, b);
    }
  }
  std::vector<std::int64_t> sizes(marked.size(), 0);
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    ++sizes[patches.first(i)];
  }
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    sizes[i] = sizes[patches.first(i)];
  }
  return sizes;
}

std::vector<double> allPositions(vtkPointSet& mesh)
{
  std::vector<double> positions(3 * static_cast<std::size_t>(mesh.GetNumberOfPoints()));
  for (std::size_t i = 0; i < positions.size(); i += 3)
  {
    mesh.GetPoint(static_cast<vtkIdType>(i / 3), positions.data() + i);
  }
  return positions;
}

/** The bytes of a point array; empty without one. */
std::vector<std::uint8_t> bytesOf(vtkPointSet& mesh, const char* name)
{
  auto* array = vtkUnsignedCharArray::SafeDownCast(mesh.GetPointData()->GetArray(name));
  return array ? std::vector<std::uint8_t>(
                   array->GetPointer(0), array->GetPointer(array->GetNumberOfTuples()))
               : std::vector<std::uint8_t>();
}

/** Where handles hold the points, 3 numbers each. */
std::vector<double> targetsOf(vtkPointSet& mesh)
{
  auto* array = vtkDoubleArray::SafeDownCast(mesh.GetPointData()->GetArray(HandleTargetName));
  return array ? std::vector<double>(
                   array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues())
               : std::vector<double>();
}

/** Marks what a mask is not 0 at; the arrays of pieces are none. */
void markBy(vtkAbstractArray* array, std::vector<std::uint8_t>& marked)
{
  auto* mask = vtkUnsignedCharArray::SafeDownCast(array);
  const std::string_view name = mask && mask->GetName() ? mask->GetName() : "";
  if (!mask || mask->GetNumberOfComponents() != 1 || name == GhostTypeName ||
      name == StreamFinalizedName)
  {
    return;
  }
  for (std::size_t i = 0; i < marked.size(); ++i)
  {
    marked[i] |= mask->GetValue(static_cast<vtkIdType>(i)) != 0 ? 1 : 0;
  }
}

} // namespace

std::vector<std::uint8_t> smallPatches(vtkPointSet& surface)
{
  std::vector<std::uint8_t> marked(static_cast<std::size_t>(surface.GetNumberOfPoints()), 0);
  for (int k = 0; k < surface.GetPointData()->GetNumberOfArrays(); ++k)
  {
    markBy(surface.GetPointData()->GetAbstractArray(k), marked);
  }
  const std::vector<std::int64_t> sizes =
    patchSizes(marked, cellCorners(surface, CellType::Triangle, "The preview"));
  for (std::size_t i = 0; i < marked.size(); ++i)
  {
    marked[i] = marked[i] && sizes[i] <= SmallPatch ? 1 : 0;
  }
  return marked;
}

bool CoarserPreview::isPossible(vtkPointSet& preview)
{
  return preview.GetNumberOfCells() > 0 && hasSimplices(preview) &&
         cellTypeOf(preview, "The preview") == CellType::Triangle;
}

CoarserPreview::CoarserPreview(
  vtkPointSet& preview, std::int64_t most, std::span<const std::uint8_t> locked)
  : Surface(coarserSurface(
      allPositions(preview), cellCorners(preview, CellType::Triangle, "The preview"), locked, most))
  , Places(vtkSmartPointer<vtkPoints>::New())
{
  this->Places->SetDataType(preview.GetPoints()->GetDataType());
  this->Places->SetNumberOfPoints(static_cast<vtkIdType>(this->points().size()));
  for (std::size_t i = 0; i < this->points().size(); ++i)
  {
    this->Places->SetPoint(static_cast<vtkIdType>(i), preview.GetPoint(this->points()[i]));
  }
}

vtkSmartPointer<vtkPointSet> CoarserPreview::of(vtkPointSet& preview) const
{
  auto mesh = vtkSmartPointer<vtkPointSet>::Take(preview.NewInstance());
  mesh->SetPoints(this->Places);
  setCells(*mesh, this->Surface.corners, cornersOf(CellType::Triangle));
  copyRows(*preview.GetPointData(), this->points(), *mesh->GetPointData());
  mesh->GetFieldData()->ShallowCopy(preview.GetFieldData());
  return mesh;
}

void KeptCoarserPreview::follow(vtkPointSet& preview, int columns, std::vector<double>& rows)
{
  const std::vector<std::int64_t> corners = cellCorners(preview, CellType::Triangle, "The preview");
  if (!this->Binding)
  {
    this->Binding.emplace(allPositions(preview), corners, this->Coarser->surface());
  }
  const auto stride = static_cast<std::size_t>(columns);
  std::vector<double> moved;
  for (std::size_t i = 0; i < rows.size(); i += stride)
  {
    moved.insert(moved.end(), rows.begin() + static_cast<std::ptrdiff_t>(i),
      rows.begin() + static_cast<std::ptrdiff_t>(i + 3));
  }
  // Where handles hold points, all of the preview are there.
  const std::vector<std::uint8_t> held = bytesOf(preview, HandleMaskName);
  const std::vector<double> targets = targetsOf(preview);
  const std::vector<double> places = targets.size() == 3 * held.size()
                                       ? this->Binding->follow(moved, held, targets)
                                       : this->Binding->follow(moved);
  if (columns == 3)
  {
    rows = places;
    return;
  }
  const std::vector<float> normals = unitNormals(normalSums({ places, corners, {} }));
  rows.clear();
  for (std::size_t i = 0; i < places.size(); i += 3)
  {
    rows.insert(rows.end(), { places[i], places[i + 1], places[i + 2] });
    rows.insert(rows.end(), { normals[i], normals[i + 1], normals[i + 2] });
  }
}

const CoarserPreview& KeptCoarserPreview::of(vtkPointSet& preview, std::int64_t most)
{
  std::vector<std::uint8_t> small = smallPatches(preview);
  vtkPoints* points = preview.GetPoints();
  if (!this->Coarser || this->Points != points || this->Time != points->GetMTime() ||
      this->Cells != preview.GetNumberOfCells() || this->Small != small || this->Most != most)
  {
    this->Coarser.emplace(preview, most, small);
    this->Binding.reset();
    this->Points = points;
    this->Time = points->GetMTime();
    this->Cells = preview.GetNumberOfCells();
    this->Small = std::move(small);
    this->Most = most;
  }
  return *this->Coarser;
}

} // namespace smg
