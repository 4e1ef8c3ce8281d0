// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Area.h"

#include "Solver/Core/Text.h"
#include "Solver/Core/Vector.h"
#include "Solver/Jobs/Fairing/MeshMeasures.h"
#include "Solver/Jobs/Values/VertexSolution.h"
#include "Solver/Memory/Ring.h"
#include "Solver/Mesh/StreamCheck.h"
#include "Solver/Mesh/VisitCells.h"
#include "Solver/Problem/MeshColumns.h"
#include "Solver/Problem/Selection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

// Areas and volumes from one reading of the stream, in windows of open vertices: the share of a
// vertex is written when no later cell uses it. Sums run over the cells in the order of the stream,
// so that blocks do not change a bit. A few nanoseconds a cell; the memory is that of the windows.

namespace smg
{
namespace
{

/** What the corners of a triangle have of its area. */
std::array<double, 3> voronoiShares(const double* const* corner, double area)
{
  std::array<double, 3> shares{};
  std::array<double, 3> dots{}; // of the two edges at each corner
  for (int k = 0; k < 3; ++k)
  {
    dots[k] =
      dot(difference(corner[(k + 1) % 3], corner[k]), difference(corner[(k + 2) % 3], corner[k]));
  }
  const auto obtuse = std::ranges::find_if(dots, [](double product) { return product < 0.0; });
  if (obtuse != dots.end() || area == 0.0)
  {
    shares.fill(area / 4.0);
    shares[static_cast<std::size_t>(obtuse == dots.end() ? 0 : obtuse - dots.begin())] = area / 2.0;
    return shares;
  }
  for (int k = 0; k < 3; ++k)
  {
    // The cotangent at corner k weighs the squared length of the edge opposite, for both its ends.
    const Vector edge = difference(corner[(k + 1) % 3], corner[(k + 2) % 3]);
    const double part = dots[k] / (2.0 * area) * dot(edge, edge) / 8.0;
    shares[(k + 1) % 3] += part;
    shares[(k + 2) % 3] += part;
  }
  return shares;
}

double areaOf(const double* const* corner)
{
  const Vector normal = cross(difference(corner[1], corner[0]), difference(corner[2], corner[0]));
  return std::sqrt(dot(normal, normal)) / 2.0;
}

double volumeOf(const double* const* corner)
{
  return std::fabs(dot(difference(corner[1], corner[0]),
           cross(difference(corner[2], corner[0]), difference(corner[3], corner[0])))) /
         6.0;
}

constexpr PoolUse AreaMemory{ "the sum of areas",
  "raise the memory limit, name a tag of fewer values, or convert the mesh with the order bfs if "
  "it "
  "has another" };

/** Of areas or volumes. */
double unitOf(const AreaDescription& description, const StreamInfo& mesh)
{
  return std::pow(description.scale, mesh.cellType == CellType::Triangle ? 2.0 : 3.0);
}

/** One computation of areas. */
class AreaPass
{
public:
  AreaPass(const StoredMesh& mesh, const AreaDescription& description, const SolveOptions& options,
    const std::string& name);
  std::unique_ptr<Solution> run();

private:
  struct Sum
  {
    std::int64_t cells = 0;
    double area = 0.0;
  };

  void requireTag();
  template <class Visit>
  void read(ProgressPart part, const Visit& visit);
  void prepare(double end);
  void add(const MeshBlock& block);
  void select(const MeshBlock& block);
  void addCell(const MeshBlock& block, const std::int64_t* corners, std::size_t c);
  double tagOf(const MeshBlock& block, std::size_t cell) const;
  Sum& sumOf(double tag);
  void write(std::int64_t finalized);
  void finishReport();

  bool isSurface() const { return this->Mesh.info().cellType == CellType::Triangle; }

  const StoredMesh& Mesh;
  const AreaDescription& Asked;
  std::unique_ptr<VertexSolution> Result;
  JobRun& Job; ///< of the result
  MeshColumns Columns;
  Selections All;
  std::vector<const Selection*> Parts; ///< null: everywhere
  std::optional<NamedColumn> Tag;
  Ring<double> Points, Shares;
  /** Of the cells of the block: whether they count, and whether they lie in a part. */
  std::vector<std::uint8_t> Counts, IsIn;
  double Unit;                ///< of areas or volumes
  std::int64_t Finalized = 0; ///< after the previous block
  Sum Total;
  std::map<double, Sum> ByTag;
  std::map<double, Sum>::iterator Last = this->ByTag.end();
  Reservation Tags; ///< the memory of these
};

AreaPass::AreaPass(const StoredMesh& mesh, const AreaDescription& description,
  const SolveOptions& options, const std::string& name)
  : Mesh(mesh)
  , Asked(description)
  , Result(std::make_unique<VertexSolution>(options, 1, "areas", AreaMemory))
  , Job(this->Result->job)
  , Columns(mesh.info(), name, &this->Job.pool)
  , All(this->Columns)
  , Points(this->Job.pool, 3)
  , Shares(this->Job.pool)
  , Unit(unitOf(description, mesh.info()))
  , Tags(this->Job.pool)
{
  for (std::size_t k = 0; k < description.of.size(); ++k)
  {
    this->Parts.push_back(this->All.add(
      description.of[k], DataPlace::Cells, ColumnOwner::Cells, "of[" + std::to_string(k) + ']'));
  }
  if (!description.tag.empty())
  {
    this->requireTag();
  }
}

void AreaPass::requireTag()
{
  this->Tag = this->Columns.require(this->Asked.tag, ColumnOwner::Cells, "tag");
  const std::string column = "the column '" + this->Asked.tag + "' ";
  if (this->Tag->owner != ColumnOwner::Cells)
  {
    this->Columns.fail("tag", column + "is one of the vertices: areas are those of cells");
  }
  if (this->Tag->components != 1)
  {
    this->Columns.fail("tag",
      column + "has " + std::to_string(this->Tag->components) + " components, but must have one");
  }
  this->Columns.requireCellIds();
}

/** Reads the mesh, and counts its cells. */
template <class Visit>
void AreaPass::read(ProgressPart part, const Visit& visit)
{
  const auto source = this->Mesh.source(this->Columns.vertexColumns(), this->Columns.cellColumns());
  StreamCheck check(this->Mesh.info().cellType);
  this->Job.read(*source, part,
    [&](const MeshBlock& block)
    {
      check.add(block);
      visit(block);
    });
  check.finish(this->Mesh.info());
  this->Job.report.cells = check.cells();
}

/** Finds the parts, by a reading of the stream up to this share of the progress. */
void AreaPass::prepare(double end)
{
  this->read({ 0.0, end },
    [this](const MeshBlock& block) { this->All.prepare(block, this->Job.options.scratch); });
  this->All.endPreparing(nullptr);
}

void AreaPass::add(const MeshBlock& block)
{
  const std::int64_t end = block.firstVertex + block.vertices();
  this->write(this->Finalized);
  this->Points.release(this->Finalized);
  this->Finalized = block.finalized;
  this->Points.extendRaw(end);
  this->Shares.extend(end);
  if (block.vertices() > 0)
  {
    std::ranges::copy(block.positions, this->Points.at(block.firstVertex));
  }
  this->select(block);
  forUnflaggedCells(this->Mesh.info().cellType, block,
    [&](const std::int64_t* corners, std::size_t c) { this->addCell(block, corners, c); });
}

/** Finds the cells that lie in one of the parts. */
void AreaPass::select(const MeshBlock& block)
{
  if (this->Parts.empty())
  {
    return;
  }
  this->All.startBlock(block);
  const std::size_t cells = cellsOf(this->Mesh.info().cellType, block);
  this->Counts.assign(cells, 0);
  this->IsIn.resize(cells);
  for (const Selection* part : this->Parts)
  {
    std::ranges::fill(this->IsIn, static_cast<std::uint8_t>(part == nullptr));
    if (part)
    {
      part->atCells({ block, 0, block.corners }, this->IsIn);
    }
    std::ranges::transform(this->Counts, this->IsIn, this->Counts.begin(), std::bit_or());
  }
}

void AreaPass::addCell(const MeshBlock& block, const std::int64_t* corners, std::size_t c)
{
  if (!this->Parts.empty() && this->Counts[c] == 0)
  {
    return;
  }
  const int count = cornersOf(this->Mesh.info().cellType);
  std::array<const double*, 4> at{};
  for (int k = 0; k < count; ++k)
  {
    at[static_cast<std::size_t>(k)] = this->Points.at(corners[k]);
  }
  const double extent = count == 3 ? areaOf(at.data()) : volumeOf(at.data());
  const double size = this->Unit * extent;
  std::array<double, 4> shares{};
  shares.fill(size / count);
  if (this->Asked.share == AreaShare::Voronoi)
  {
    std::ranges::transform(voronoiShares(at.data(), extent), shares.begin(),
      [this](double share) { return this->Unit * share; });
  }
  for (int k = 0; k < count; ++k)
  {
    this->Shares[corners[k]] += shares[static_cast<std::size_t>(k)];
  }
  ++this->Total.cells;
  this->Total.area += size;
  if (this->Tag)
  {
    Sum& sum = this->sumOf(this->tagOf(block, c));
    ++sum.cells;
    sum.area += size;
  }
}

double AreaPass::tagOf(const MeshBlock& block, std::size_t cell) const
{
  const double tag = this->Tag->in(block).value(cell);
  if (const char* flaw = flawOf(this->Tag->in(block).spec.type, tag))
  {
    this->Columns.fail("tag", "the column '" + this->Asked.tag + "' " + flaw + " in " +
                                this->Columns.cellName(block, cell));
  }
  return tag;
}

/** Neighbouring cells mostly have one tag. */
AreaPass::Sum& AreaPass::sumOf(double tag)
{
  if (this->Last != this->ByTag.end() && this->Last->first == tag)
  {
    return this->Last->second;
  }
  this->Last = this->ByTag.find(tag);
  if (this->Last == this->ByTag.end())
  {
    if (this->ByTag.size() == AreaDescription::MaxTags)
    {
      this->Columns.fail("tag", "the column '" + this->Asked.tag + "' has more than " +
                                  std::to_string(AreaDescription::MaxTags) +
                                  " values: name one that says to which part a cell belongs");
    }
    // A node of the map takes about so much.
    constexpr std::size_t NodeBytes = 80;
    this->Tags.resize(static_cast<std::int64_t>((this->ByTag.size() + 1) * NodeBytes));
    this->Last = this->ByTag.try_emplace(tag).first;
  }
  return this->Last->second;
}

/** Writes the shares of the vertices that no later cell uses. */
void AreaPass::write(std::int64_t finalized)
{
  this->Result->values.append(this->Shares.range(this->Shares.first(), finalized));
  this->Shares.release(finalized);
}

void AreaPass::finishReport()
{
  Report& report = this->Job.report;
  report.vertices = this->Result->vertices();
  report.converged = true;
  Report::Areas& areas = report.areas.emplace();
  areas.isVolume = !this->isSurface();
  areas.cells = this->Total.cells;
  areas.total = this->Total.area;
  areas.hasTags = this->Tag.has_value();
  for (const auto& [tag, sum] : this->ByTag)
  {
    areas.by_tag.push_back({ tag, sum.cells, sum.area });
  }
  report.notes.push_back((areas.isVolume ? "volume " : "area ") + shortest(areas.total) + " of " +
                         counted(areas.cells, "cell", "cells"));
  this->Job.finishReport();
}

std::unique_ptr<Solution> AreaPass::run()
{
  constexpr double PrepareShare = 0.4;
  const bool hasParts = !this->Asked.of.empty();
  if (hasParts)
  {
    this->prepare(PrepareShare);
  }
  this->read(
    { hasParts ? PrepareShare : 0.0, 1.0 }, [this](const MeshBlock& block) { this->add(block); });
  this->write(this->Shares.end());
  this->Job.endProgress();
  this->finishReport();
  return std::move(this->Result);
}

} // namespace

ColumnSpec areaColumn(const StreamInfo& mesh)
{
  return { mesh.cellType == CellType::Triangle ? AreaName : VolumeName, ScalarType::Float64, 1,
    0.0 };
}

std::unique_ptr<Solution> area(const StoredMesh& mesh, const AreaDescription& description,
  const SolveOptions& options, const std::string& name)
{
  checkOptions(options);
  refuseCheckpoint(options, "areas have");
  require(description.scale > 0.0 && std::isnormal(unitOf(description, mesh.info())),
    name + ": scale: must be above 0, and such that areas are numbers in double precision.");
  require(description.share != AreaShare::Voronoi || mesh.info().cellType == CellType::Triangle,
    name + ": share: voronoi is for triangles: share tetrahedra equally.");
  return AreaPass(mesh, description, options, name).run();
}

} // namespace smg
