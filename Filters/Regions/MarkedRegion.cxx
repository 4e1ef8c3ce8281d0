// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/MarkedRegion.h"

#include "Filters/Regions/RegionPoints.h"
#include "IO/Vtk/GroupData.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PieceColumns.h"
#include "IO/Vtk/PieceStream.h"
#include "Solver/Assembly/Facets.h"
#include "smg/Error.h"
#include "smg/Groups.h"
#include "smg/MeshSource.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>

namespace smg
{

void MarkedRegion::set(const MarkedRegionSettings& settings)
{
  if (!(this->Asked == settings))
  {
    this->Asked = settings;
    this->OnDisplay.reset();
    this->OnMesh.reset();
  }
}

bool MarkedRegion::isByItself(vtkPointSet& piece, const PieceRequest& request) const
{
  const bool isGroup = !this->Asked.group.empty();
  if (isPreview(piece))
  {
    // Previews lack the arrays of the cells; their points are points of the mesh.
    return this->Asked.isBoundary() ||
           (!isGroup && piece.GetCellData()->HasArray(this->Asked.array.c_str()));
  }
  const bool isWhole = !request.IsStreamed && request.Pieces == 1;
  if (isWhole && isGroup)
  {
    // The corners of facets are found by a stream, which an ordinary mesh is not.
    return lacksStreamNumbering(piece);
  }
  if (!isWhole && lacksStreamNumbering(piece))
  {
    // A filter that solves looks at a piece first, and then requests all of an ordinary mesh.
    if (!request.IsStreamed || hasSeveralProcesses())
    {
      throw Error("The pieces of the mesh have no GlobalIds, so that the region cannot extend "
                  "across them: save the mesh as .vsm and open that.");
    }
    return true;
  }
  return isWhole;
}

vtkPointSet& MarkedRegion::fetchPiece(
  const PieceRequest& request, const RegionContext& context, HeldPoints& held)
{
  const auto update = [&context, &request]
  { return vtkPointSet::SafeDownCast(request.update(context.input)); };
  vtkPointSet* piece = update();
  vtkDataArray* ofPoints = this->Asked.array.empty()
                             ? nullptr
                             : piece->GetPointData()->GetArray(this->Asked.array.c_str());
  if (piece->GetNumberOfPoints() == 0)
  {
    held = {};
  }
  else if (ofPoints)
  {
    held = heldByPointArray(*piece, *ofPoints, this->Asked);
  }
  else if (this->isByItself(*piece, request))
  {
    held =
      this->OnDisplay.of(*piece, request, context.stamp(), [&] { return this->holdShown(*piece); });
  }
  else
  {
    this->find(context);
    piece = update();
    held = HeldPoints{ .by = {}, .holders = 1, .anchors = {} };
    for (const std::int64_t id : globalIdsOf(*piece, "The input"))
    {
      held.by.push_back(this->OnMesh->vertices->contains(id) ? 0 : -1);
    }
  }
  return *piece;
}

HeldPoints MarkedRegion::holdShown(vtkPointSet& mesh) const
{
  if (this->Asked.isBoundary())
  {
    return heldOnBoundary(mesh);
  }
  if (!this->Asked.group.empty())
  {
    return heldByGroup(mesh, this->Asked.group);
  }
  requireArrays(mesh, { this->Asked.array });
  return heldByCellArray(
    mesh, *mesh.GetCellData()->GetArray(this->Asked.array.c_str()), this->Asked);
}

void MarkedRegion::find(const RegionContext& context)
{
  if (this->OnMesh && this->OnMesh->stamp == context.stamp())
  {
    return;
  }
  this->OnMesh.reset();
  PieceColumns columns{ .all = false, .required = {}, .optional = { CellFlagsName } };
  if (!this->Asked.array.empty())
  {
    columns.required.insert(this->Asked.array);
  }
  if (!this->Asked.group.empty())
  {
    columns.optional.insert({ VertexGroupsName, FacetGroupsName, CellGroupsName });
  }
  PieceStream stream(context.mesh, { .given = this->Asked.pieces }, columns);
  auto vertices =
    std::make_unique<SelectedVertices>(this->Asked.where(), stream.info(), "The input");
  MeshBlock block;
  while (stream.next(block))
  {
    vertices->add(block);
    context.progress.update(stream.fraction());
  }
  vertices->finish();
  // Only here: requesting pieces may itself update modification times of the pipeline.
  this->OnMesh = Found{ context.stamp(), std::move(vertices) };
}

namespace
{

HeldPoints noneHeld(vtkPointSet& mesh)
{
  HeldPoints held;
  held.holders = 1;
  held.by.assign(static_cast<std::size_t>(mesh.GetNumberOfPoints()), -1);
  return held;
}

void requireOneComponent(vtkDataArray& array)
{
  if (array.GetNumberOfComponents() != 1)
  {
    throw Error(std::string("The array ") + array.GetName() + " of the region has " +
                std::to_string(array.GetNumberOfComponents()) +
                " components: choose one with a single component.");
  }
}

/** The cells of a mesh that count for its boundary. */
class OwnCells
{
public:
  explicit OwnCells(vtkPointSet& mesh)
    : Ghosts(mesh.GetCellGhostArray())
    , Flags(mesh.GetCellData()->GetArray(CellFlagsName))
  {
  }

  bool contain(vtkIdType cell) const
  {
    const bool isGhost =
      this->Ghosts && (this->Ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) != 0;
    const bool isFlagged =
      this->Flags && (static_cast<unsigned>(this->Flags->GetTuple1(cell)) & DuplicateCell) != 0;
    return !isGhost && !isFlagged;
  }

private:
  vtkUnsignedCharArray* Ghosts;
  vtkDataArray* Flags;
};

/** Calls visit(points) for each facet of the cells of a mesh that count: the faces of solid cells,
 * or without these the edges of polygons. `points` may be reordered. */
class Facets
{
public:
  explicit Facets(vtkPointSet& mesh)
    : Mesh(mesh)
    , Own(mesh)
  {
    for (vtkIdType cell = 0; cell < mesh.GetNumberOfCells() && !this->AreFaces; ++cell)
    {
      mesh.GetCell(cell, this->Cell);
      this->AreFaces = this->Cell->GetCellDimension() == 3;
    }
  }

  template <class Visit>
  void visit(Visit&& visit)
  {
    for (vtkIdType cell = 0; cell < this->Mesh.GetNumberOfCells(); ++cell)
    {
      if (!this->Own.contain(cell))
      {
        continue;
      }
      this->Mesh.GetCell(cell, this->Cell);
      const int dimension = this->Cell->GetCellDimension();
      if (this->AreFaces ? dimension == 3 : dimension == 2)
      {
        this->AreFaces                                    ? this->visitFaces(visit)
        : this->Cell->GetCellType() == VTK_TRIANGLE_STRIP ? this->visitStrip(visit)
                                                          : this->visitEdges(visit);
      }
    }
  }

private:
  /** Whether a simplex uses a point twice: it has no area or volume. */
  bool isFlat(int corners)
  {
    vtkIdList* points = this->Cell->GetPointIds();
    std::span<vtkIdType> ids(points->GetPointer(0), points->GetNumberOfIds());
    return static_cast<int>(ids.size()) == corners &&
           std::ranges::any_of(
             ids, [ids](vtkIdType id) { return std::ranges::count(ids, id) > 1; });
  }

  template <class Visit>
  void visitPoints(vtkIdList* points, Visit& visit)
  {
    visit(std::span<vtkIdType>(points->GetPointer(0), points->GetNumberOfIds()));
  }

  template <class Visit>
  void visitFaces(Visit& visit)
  {
    for (int face = 0; !this->isFlat(4) && face < this->Cell->GetNumberOfFaces(); ++face)
    {
      this->visitPoints(this->Cell->GetFace(face)->GetPointIds(), visit);
    }
  }

  template <class Visit>
  void visitEdges(Visit& visit)
  {
    for (int edge = 0; !this->isFlat(3) && edge < this->Cell->GetNumberOfEdges(); ++edge)
    {
      this->visitPoints(this->Cell->GetEdge(edge)->GetPointIds(), visit);
    }
  }

  /** VTK has those of the outline, which is not that of the triangles. */
  template <class Visit>
  void visitStrip(Visit& visit)
  {
    vtkIdList* points = this->Cell->GetPointIds();
    for (vtkIdType i = 2; i < points->GetNumberOfIds(); ++i)
    {
      const std::array<vtkIdType, 3> corners{ points->GetId(i - 2), points->GetId(i - 1),
        points->GetId(i) };
      // Strips are joined by triangles that use a point twice.
      const bool isFlat =
        corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
      for (std::size_t k = 0; !isFlat && k < 3; ++k)
      {
        std::array<vtkIdType, 2> edge{ corners[k], corners[(k + 1) % 3] };
        visit(std::span<vtkIdType>(edge));
      }
    }
  }

  vtkPointSet& Mesh;
  OwnCells Own;
  vtkNew<vtkGenericCell> Cell;
  bool AreFaces = false;
};

/** The three lowest points of a facet, which identify it; the third one of an edge is 0. */
std::array<std::int64_t, 3> nameOf(std::span<vtkIdType> points)
{
  std::ranges::sort(points);
  return { points[0], points[1], points.size() > 2 ? points[2] : 0 };
}

} // namespace

HeldPoints heldEverywhere(vtkPointSet& piece)
{
  HeldPoints held = noneHeld(piece);
  std::ranges::fill(held.by, 0);
  return held;
}

HeldPoints heldByPointArray(
  vtkPointSet& piece, vtkDataArray& array, const MarkedRegionSettings& settings)
{
  requireOneComponent(array);
  HeldPoints held = noneHeld(piece);
  for (std::size_t i = 0; i < held.by.size(); ++i)
  {
    const double value = array.GetTuple1(static_cast<vtkIdType>(i));
    held.by[i] = settings.isMarked(value, array.GetDataType() == VTK_FLOAT) ? 0 : -1;
  }
  return held;
}

HeldPoints heldByCellArray(
  vtkPointSet& mesh, vtkDataArray& array, const MarkedRegionSettings& settings)
{
  requireOneComponent(array);
  HeldPoints held = noneHeld(mesh);
  const vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    if (settings.isMarked(array.GetTuple1(cell), array.GetDataType() == VTK_FLOAT))
    {
      mesh.GetCellPoints(cell, points);
      for (vtkIdType k = 0; k < points->GetNumberOfIds(); ++k)
      {
        held.by[static_cast<std::size_t>(points->GetId(k))] = 0;
      }
    }
  }
  return held;
}

HeldPoints heldByGroup(vtkPointSet& mesh, const std::string& name)
{
  const MeshGroups groups = groupsIn(mesh);
  // Of the kinds that have the name, the first one counts, as in problems.
  constexpr std::array kinds{ GroupOf::Facets, GroupOf::Vertices, GroupOf::Cells };
  const auto* const kind = std::ranges::find_if(
    kinds, [&](GroupOf candidate) { return !groups.find(name, candidate).empty(); });
  if (kind == kinds.end())
  {
    throw Error("The mesh has no group '" + name + "'" +
                (groups.empty() ? "." : "; it has " + groups.listFor(name) + '.'));
  }
  const std::vector<std::uint8_t> wanted = groups.setsWith(groups.find(name, *kind));
  HeldPoints held = noneHeld(mesh);
  vtkDataArray* const sets =
    mesh.GetAttributes(*kind == GroupOf::Vertices ? vtkDataObject::POINT : vtkDataObject::CELL)
      ->GetArray(MeshGroups::columnOf(*kind));
  const auto isWanted = [&](vtkIdType tuple, int component)
  {
    const double set = sets->GetComponent(tuple, component);
    return set >= 0.0 && set < static_cast<double>(wanted.size()) &&
           wanted[static_cast<std::size_t>(set)] != 0;
  };
  const vtkNew<vtkIdList> points;
  for (vtkIdType tuple = 0; sets && tuple < sets->GetNumberOfTuples(); ++tuple)
  {
    for (int k = 0; k < sets->GetNumberOfComponents(); ++k)
    {
      if (!isWanted(tuple, k))
      {
        continue;
      }
      points->Reset();
      *kind == GroupOf::Vertices ? void(points->InsertNextId(tuple))
                                 : mesh.GetCellPoints(tuple, points);
      // Facets of other cells, as of a solid whose surface this is, are none here.
      if (*kind == GroupOf::Facets && sets->GetNumberOfComponents() != points->GetNumberOfIds())
      {
        continue;
      }
      for (vtkIdType corner = 0; corner < points->GetNumberOfIds(); ++corner)
      {
        // A facet is opposite to the corner of its component.
        if (*kind != GroupOf::Facets || corner != k)
        {
          held.by[static_cast<std::size_t>(points->GetId(corner))] = 0;
        }
      }
    }
  }
  return held;
}

HeldPoints heldOnBoundary(vtkPointSet& mesh)
{
  if (isSurfaceOfSolid(mesh))
  {
    return heldEverywhere(mesh);
  }
  HeldPoints held = noneHeld(mesh);
  Pool memory(std::numeric_limits<std::int64_t>::max());
  OpenFacets open(memory);
  open.extend(mesh.GetNumberOfPoints());
  Facets facets(mesh);
  facets.visit(
    [&open](std::span<vtkIdType> points)
    {
      if (points.size() > 1)
      {
        const auto [low, middle, high] = nameOf(points);
        open.add(low, middle, high, 0);
      }
    });
  facets.visit(
    [&](std::span<vtkIdType> points)
    {
      if (points.size() < 2)
      {
        return;
      }
      const auto [low, middle, high] = nameOf(points);
      open.visit(low,
        [&](std::int64_t second, std::int64_t third, bool isShared)
        {
          if (second == middle && (points.size() == 2 || third == high) && !isShared)
          {
            for (const vtkIdType point : points)
            {
              held.by[static_cast<std::size_t>(point)] = 0;
            }
          }
        });
    });
  return held;
}

} // namespace smg
