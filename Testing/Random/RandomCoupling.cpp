// SPDX-License-Identifier: BSD-3-Clause
// Random problems with coupled vertices: one box or two with a contact between them, whose outer
// sides may be one. The sides match, whatever is in between: columns, conditions and the order of
// vertices and cells are random.
#include "Testing/Random/Case.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace smg::testing
{
namespace
{

using nlohmann::json;

/** A rectangle of nx x ny squares, two triangles each, or a box of cubes. */
IndexedTestMesh lattice(bool isSolid, std::int64_t nx, std::int64_t ny)
{
  if (isSolid)
  {
    return tetBox(static_cast<int>(nx) + 1, static_cast<int>(ny) + 1, 3);
  }
  IndexedTestMesh mesh;
  for (std::int64_t v = 0; v < (nx + 1) * (ny + 1); ++v)
  {
    mesh.positions.insert(mesh.positions.end(),
      { static_cast<double>(v % (nx + 1)), static_cast<double>(v / (nx + 1)), 0.0 });
  }
  for (std::int64_t c = 0; c < nx * ny; ++c)
  {
    const std::int64_t v = c / nx * (nx + 1) + c % nx, above = v + nx + 1;
    mesh.corners.insert(mesh.corners.end(), { v, v + 1, above, v + 1, above + 1, above });
  }
  return mesh;
}

/** What a body is apart from the next one before they are moved together. */
constexpr double Apart = 0.5;

} // namespace

void ProblemMaker::coupleSides()
{
  Case& to = this->To;
  const bool isSolid = this->chance(0.5), hasContact = this->chance(0.6);
  const std::int64_t nx = 4 + this->Numbers.below(4), ny = 1 + this->Numbers.below(4);
  const auto length = static_cast<double>(nx);
  IndexedTestMesh mesh = lattice(isSolid, nx, ny);
  if (hasContact)
  {
    mesh = disjointUnion(mesh, mesh, { length + Apart, 0, 0 });
  }
  mesh = shuffled(mesh, this->Numbers.bits());
  Case fresh;
  fresh.seed = to.seed;
  fresh.run = to.run;
  to = fresh;
  to.type = mesh.cellType;
  to.points = mesh.positions;
  to.corners = mesh.corners;
  to = to.part(std::vector<std::uint8_t>(static_cast<std::size_t>(to.cells()), 1));
  this->addColumns();
  to.groups.groups = { { "left", 1, GroupOf::Facets }, { "right", 2, GroupOf::Facets },
    { "gap", 3, GroupOf::Facets } };
  to.groups.sets = { {}, { 0 }, { 1 }, { 2 } };
  const int size = cornersOf(to.type);
  const double last = hasContact ? 2.0 * length + Apart : length;
  std::int64_t facet = 0;
  this->addColumn(true, FacetGroupsName, size, true,
    [&](int k)
    {
      const std::int64_t* cell = to.cell(facet++ / size);
      const auto isAt = [&](double x)
      {
        bool is = true;
        for (int i = 0; i < size; ++i)
        {
          is = is && (i == k || to.points[3 * static_cast<std::size_t>(cell[i])] == x);
        }
        return is;
      };
      return isAt(0.0)                                              ? 1.0
             : isAt(last)                                           ? 2.0
             : hasContact && (isAt(length) || isAt(length + Apart)) ? 3.0
                                                                    : 0.0;
    });
  this->Inside.clear();
  for (std::int64_t v = 0; v < to.vertices(); ++v)
  {
    double* p = &to.points[3 * static_cast<std::size_t>(v)];
    const double x = p[0] > length ? p[0] - Apart : p[0];
    if (p[0] > 0.0 && p[0] < length)
    {
      this->Inside.push_back(v);
    }
    p[0] = x;
  }
  const double shear = this->uniform(-0.4, 0.4), wave = this->uniform(-0.3, 0.3);
  for (auto p = to.points.begin(); p != to.points.end(); p += 3)
  {
    const double phase = 2.0 * std::numbers::pi * std::round(p[0]) / length;
    const double y = p[1];
    p[0] += shear * y;
    p[1] += wave * std::sin(phase);
    p[2] += wave * std::cos(phase) * (1.0 + y);
  }
  to.problem = json{ { "columns", this->Columns } };
  if (hasContact)
  {
    to.problem["interface"] = { { { "group", "gap" }, { "coefficient", this->positive() } } };
  }
  if (!hasContact || this->chance(0.6))
  {
    json sides{ { "sides", { "left", "right" } } };
    if (this->chance(0.7))
    {
      for (int k = 0; k < this->Columns; ++k)
      {
        sides["jump"].push_back(this->uniform(-1, 1));
      }
    }
    to.problem["periodic"] = json::array({ sides });
  }
}

/** What is stated at vertices holds away from the sides, or everywhere. */
void ProblemMaker::addCoupledData()
{
  json& problem = this->To.problem;
  const auto numbers = [this]
  {
    json values = json::array();
    for (int k = 0; k < this->Columns; ++k)
    {
      values.push_back(this->uniform(-1, 1));
    }
    return values;
  };
  for (std::int64_t k = this->Numbers.below(2); k >= 0; --k)
  {
    const auto vertex = this->Inside[static_cast<std::size_t>(
      this->Numbers.below(static_cast<std::int64_t>(this->Inside.size())))];
    problem["dirichlet"].push_back(
      { { "vertices", { vertex } }, { "value", this->chance(0.5) ? numbers() : json("vAll") } });
  }
  if (this->chance(0.6))
  {
    problem["conductivity"] = this->chance(0.3)
                                ? json(this->positive())
                                : json(this->oneOf({ "cOne", "cDiagonal", "cTensor", "vOne" }));
  }
  if (this->chance(0.3))
  {
    problem["field"] = "field";
  }
  if (this->chance(0.3))
  {
    problem["screening"] = this->chance(0.5) ? json(this->positive()) : json("cOne");
  }
  if (this->chance(0.6))
  {
    problem["source"] = this->chance(0.5) ? numbers() : json("cAll");
  }
  if (this->chance(0.4))
  {
    problem["flux"].push_back({ { "boundary", true }, { "value", this->value(true) } });
  }
  if (this->chance(0.4))
  {
    problem["robin"].push_back({ { "boundary", true }, { "ambient", this->value(true) },
      { "coefficient", this->coefficient(true, false) } });
  }
  problem["outputs"] = { "gradient", "flux" };
}

} // namespace smg::testing
