// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Blending/BlendProblem.h"

#include "Solver/Assembly/Elements.h"
#include "Solver/Mesh/VisitCells.h"
#include "Solver/Problem/MeshColumns.h"
#include "smg/CellWeights.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>

// Gradient-domain fusion of columns that were recorded in patches (Perez, Gangnet and Blake 2003;
// docs/blend.md): the problem for the correction of all columns, the columns themselves, the mean
// gradients beside the seams, and the steps across them. Cells between patches get a field that
// cancels their gradient, or replaces it by the mean of those around; sources and the corrections
// of held vertices are 0, so that a component of the mesh without seams does not change at all.
//
// Each cell is treated by itself, and sums over cells run in the order of the stream: blocks do not
// change a bit. In memory are labels and values at open vertices; the original values, and the mean
// gradients if they are wanted, go to vertex files.

namespace smg
{

namespace
{

/** The place in the description that errors of columns name. */
constexpr const char* Key = "columns";

} // namespace

BlendedColumns::BlendedColumns(
  const BlendDescription& description, const StreamInfo& mesh, MeshColumns& columns)
  : Columns(columns)
{
  if (description.columns.empty())
  {
    columns.fail(Key, "must name at least one column of the vertices");
  }
  for (const std::string& name : description.columns)
  {
    this->add(name, description, mesh);
  }
  if (this->Components > BlendDescription::MaxComponents)
  {
    columns.fail(Key, "have " + std::to_string(this->Components) +
                        " components together; at most " +
                        std::to_string(BlendDescription::MaxComponents) +
                        " are blended at once: blend them one after the other");
  }
}

/** Adds a column after checking that blending it makes sense: numbers of vertices or patches are
 * names, not values. */
void BlendedColumns::add(
  const std::string& name, const BlendDescription& description, const StreamInfo& mesh)
{
  const NamedColumn column = this->Columns.require(name, ColumnOwner::Vertices, Key);
  if (column.owner == ColumnOwner::Cells)
  {
    this->Columns.fail(
      Key, "'" + name + "' is a column of the cells; only columns of the vertices are blended");
  }
  if (name == OriginalIdName || name == description.patch)
  {
    this->Columns.fail(Key, "'" + name + "' numbers " +
                              (name == description.patch ? "the patches" : "the vertices") +
                              " and cannot be blended");
  }
  if (std::ranges::find(this->Specs, name, &ColumnSpec::name) != this->Specs.end())
  {
    this->Columns.fail(Key, "name '" + name + "' twice");
  }
  this->Named.push_back(column);
  this->Specs.push_back(*std::ranges::find(mesh.vertexColumns, name, &ColumnSpec::name));
  this->Components += column.components;
}

/** The components of all columns lie one after the other at each vertex; checked here, where the
 * vertex can be named. */
void BlendedColumns::read(const MeshBlock& block, std::span<double> values) const
{
  const auto stride = static_cast<std::size_t>(this->Components);
  std::size_t first = 0;
  for (const NamedColumn& named : this->Named)
  {
    const Column& column = named.in(block);
    const auto components = static_cast<std::size_t>(named.components);
    dispatch(column.spec.type,
      [&]<class T>(T)
      {
        const std::span<const T> numbers = column.as<T>();
        for (std::size_t k = 0; k < numbers.size(); ++k)
        {
          const auto number = static_cast<double>(numbers[k]);
          if (const char* flaw = flawOf(column.spec.type, number))
          {
            this->Columns.fail(Key, "'" + named.name + "' " + flaw + " at " +
                                      this->Columns.vertexName(block, k / components));
          }
          values[k / components * stride + first + k % components] = number;
        }
      });
    first += components;
  }
}

PatchGradients::PatchGradients(const VertexStorage& storage, Pool& open, CellType type, int columns)
  : Type(type)
  , Columns(static_cast<std::size_t>(columns))
  , File(storage, 1 + 3 * columns)
  , Points(open, 3)
  , Sums(open, 1 + 3 * columns)
  , Known(open, 1 + 3 * columns)
{
}

/** Adds the cells of a block that lie in one patch, and writes the sums of vertices that no later
 * cell uses. */
void PatchGradients::add(const MeshBlock& block, const PatchedValues& values)
{
  std::ranges::copy(block.positions, this->Points.append(block.vertices()).begin());
  std::ranges::fill(this->Sums.append(block.vertices()), 0.0);
  this->Vertices += block.vertices();
  forAllCells(this->Type, block,
    [&](const std::int64_t* corners, unsigned flags, std::size_t /*c*/)
    {
      const std::span cell(corners, static_cast<std::size_t>(cornersOf(this->Type)));
      // Flagged cells have no weight, hence no share of a mean.
      if (flags == 0 && values.inOnePatch(cell))
      {
        this->addCell(cell, values);
      }
    });
  this->append(block.finalized);
  // The file has the sums now.
  this->Points.release(block.finalized);
  this->Sums.release(block.finalized);
}

/** Adds the gradients in a cell, times its area or volume, to the sums at its corners. */
void PatchGradients::addCell(std::span<const std::int64_t> corners, const PatchedValues& values)
{
  const double* point[4] = {};
  const double* value[4] = {};
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    point[k] = this->Points.at(corners[k]);
    value[k] = values.at(corners[k]);
  }
  const double measure = cellWeights(this->Type, point).measure;
  if (measure == 0.0)
  {
    return;
  }
  const CellGradients gradients(this->Type, point);
  for (std::size_t column = 0; column < this->Columns; ++column)
  {
    const Vector gradient = gradients.of(this->Type, value, static_cast<int>(column));
    for (const std::int64_t corner : corners)
    {
      double* sum = this->Sums.at(corner) + 1 + 3 * column;
      for (std::size_t d = 0; d < 3; ++d)
      {
        sum[d] += measure * gradient[d];
      }
    }
  }
  for (const std::int64_t corner : corners)
  {
    *this->Sums.at(corner) += measure;
  }
}

/** Appends the vertices below `end` to the file. */
void PatchGradients::append(std::int64_t end)
{
  if (end > this->Written)
  {
    const std::size_t lanes = 1 + 3 * this->Columns;
    this->File.append(
      { this->Sums.at(this->Written), static_cast<std::size_t>(end - this->Written) * lanes });
    this->Written = end;
  }
}

void PatchGradients::finish()
{
  this->append(this->Vertices);
  this->Points.restart();
  this->Sums.restart();
}

/** Reads the sums of the vertices of a block again; kept for the cells of later blocks. */
void PatchGradients::startBlock(const MeshBlock& block)
{
  const std::span<double> known = this->Known.startBlock(block);
  if (!known.empty())
  {
    this->File.read(block.firstVertex, block.vertices(), known.data());
  }
}

void PatchGradients::average(
  std::span<const std::int64_t> corners, std::vector<double>& gradients) const
{
  gradients.assign(3 * this->Columns, 0.0);
  double measure = 0.0;
  // A cell that has several of the corners is in several of the sums, and counts as often.
  for (const std::int64_t corner : corners)
  {
    const double* sum = this->Known.at(corner);
    measure += sum[0];
    std::transform(gradients.begin(), gradients.end(), sum + 1, gradients.begin(), std::plus<>());
  }
  if (measure > 0.0)
  {
    std::ranges::for_each(gradients, [measure](double& number) { number /= measure; });
  }
}

SeamSteps::SeamSteps(const std::vector<ColumnSpec>& columns)
{
  for (const ColumnSpec& column : columns)
  {
    this->Components.push_back(column.components);
  }
  this->Steps.resize(
    static_cast<std::size_t>(std::accumulate(this->Components.begin(), this->Components.end(), 0)));
}

/** Compares the ends of the edges of a cell that lies between patches. */
void SeamSteps::add(std::span<const std::int64_t> corners, const PatchedValues& values)
{
  if (values.inOnePatch(corners))
  {
    return;
  }
  ++this->Cells;
  for (std::size_t j = 1; j < corners.size(); ++j)
  {
    for (std::size_t i = 0; i < j; ++i)
    {
      // A cell between patches may have edges inside one.
      if (values.inOnePatch(corners[i], corners[j]))
      {
        continue;
      }
      ++this->Edges;
      const double* a = values.at(corners[i]);
      const double* b = values.at(corners[j]);
      for (std::size_t k = 0; k < this->Steps.size(); ++k)
      {
        this->Steps[k] = std::max(this->Steps[k], std::fabs(a[k] - b[k]));
      }
    }
  }
}

/** The largest step of each column, over its components. */
std::vector<double> SeamSteps::largest() const
{
  std::vector<double> largest;
  auto step = this->Steps.begin();
  for (const int components : this->Components)
  {
    largest.push_back(*std::max_element(step, step + components));
    step += components;
  }
  return largest;
}

BlendProblem::BlendProblem(const BlendDescription& description, const StreamInfo& mesh)
  : OfMesh(mesh, "blend")
  , Blended(description, mesh, this->OfMesh)
  , Patches(description.patch, this->OfMesh)
  , Open(this->Patches, this->Blended.components())
  , Steps(this->Blended.specs())
  , Held(description.hold, false, this->OfMesh)
  , Check(mesh.cellType)
  , Anchor(description.anchor)
{
  this->Low.fill(std::numeric_limits<double>::max());
  this->High.fill(std::numeric_limits<double>::lowest());
  // In this form, NaN is refused, too.
  if (!(this->Anchor >= 0.0 && std::isfinite(this->Anchor)))
  {
    this->OfMesh.fail("anchor", "must be a finite number of at least 0");
  }
  // Below, the rounding of the sum of a body's right-hand side, over the anchor, would move the
  // body farther than the anchor does.
  constexpr double Least = 1e-8;
  this->Anchor = this->Anchor < Least ? 0.0 : this->Anchor;
}

void BlendProblem::prepare(const MeshBlock& block, const std::filesystem::path& scratch)
{
  this->Check.add(block);
  for (std::size_t k = 0; k < block.positions.size(); ++k)
  {
    this->Low[k % 3] = std::min(this->Low[k % 3], block.positions[k]);
    this->High[k % 3] = std::max(this->High[k % 3], block.positions[k]);
  }
  this->Patches.prepare(block, scratch);
  this->Held.prepare(block, scratch);
}

/** Sets the screening A / D^2 from the diagonal D of the bounding box, which is known only now. */
void BlendProblem::endPreparing()
{
  this->Patches.endPreparing();
  this->Held.endPreparing(false);
  const Vector diagonal = difference(this->High.data(), this->Low.data());
  const double squared = dot(diagonal, diagonal);
  // Cells of a mesh without extent have no weight.
  this->Screening = squared > 0.0 ? this->Anchor / squared : 0.0;
}

void BlendProblem::addTo(PatchGradients& gradients, const MeshBlock& block)
{
  this->Blended.read(block, this->Open.startBlock(block));
  gradients.add(block, this->Open);
}

/** Starts a block in all windows, and prescribes the correction 0 at held vertices. */
void BlendProblem::conditions(const MeshBlock& block, VertexConditions& conditions)
{
  const std::span<double> values = this->Open.startBlock(block);
  this->Blended.read(block, values);
  // Blocks come in order, so that the values can be appended.
  if (this->Originals)
  {
    this->Originals->append(values);
  }
  if (this->Gradients)
  {
    this->Gradients->startBlock(block);
  }
  std::ranges::fill(conditions.screening, this->Screening);
  const std::span<const std::uint8_t> held = this->Held.at(block);
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    // The correction of a held vertex is 0, which is the value on entry.
    conditions.dirichlet[i] = held[i] ? 0 : -1;
  }
}

/** Sets the field of the cells between patches, and measures their steps. */
void BlendProblem::cells(CellBatch& batch)
{
  const auto corners = static_cast<std::size_t>(cornersOf(batch.type));
  const auto columns = static_cast<std::size_t>(this->columns());
  for (std::size_t c = 0; c < batch.cells(); ++c)
  {
    const auto corner = batch.corners.subspan(c * corners, corners);
    // Its gradient is kept: the field of the correction is 0.
    if (this->Open.inOnePatch(corner))
    {
      continue;
    }
    this->Steps.add(corner, this->Open);
    if (batch.measure[c] == 0.0)
    {
      // Degenerate: without a weight, and without a gradient. Its edges count as steps all the
      // same.
      continue;
    }
    const double* point[4] = {};
    const double* value[4] = {};
    for (std::size_t k = 0; k < corners; ++k)
    {
      point[k] = batch.point(c, static_cast<int>(k));
      value[k] = this->Open.at(corner[k]);
    }
    this->Mean.assign(3 * columns, 0.0);
    if (this->Gradients)
    {
      this->Gradients->average(corner, this->Mean);
    }
    const CellGradients gradients(batch.type, point);
    for (std::size_t k = 0; k < columns; ++k)
    {
      // q - grad c, where q is the mean around the cell, or 0.
      const Vector gradient = gradients.of(batch.type, value, static_cast<int>(k));
      for (std::size_t d = 0; d < 3; ++d)
      {
        batch.field[3 * (c * columns + k) + d] = this->Mean[3 * k + d] - gradient[d];
      }
    }
  }
}

} // namespace smg
