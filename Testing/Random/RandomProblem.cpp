// SPDX-License-Identifier: BSD-3-Clause
// Random problems: each datum in each form, placed by each kind of place, with columns of the
// vertices and of the cells, several right-hand sides, bodies without any condition.
#include "Testing/Random/Case.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>

namespace smg::testing
{

using nlohmann::json;

ProblemMaker::ProblemMaker(Case& to, Random& random)
  : To(to)
  , Numbers(random)
  , Columns(1 + static_cast<int>(random.below(3)))
  , Contrast(this->chance(0.3) ? 2.0 : 0.3)
{
}

double ProblemMaker::someLength()
{
  const double* p = this->somePoint();
  const double* q = this->somePoint();
  const double length = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  return length > 0.0 ? length : this->someLength();
}

void ProblemMaker::addColumn(
  bool ofCells, const char* name, int components, bool isInteger, auto make)
{
  CaseColumn column{ name, components, {}, isInteger };
  const std::int64_t rows = ofCells ? this->To.cells() : this->To.vertices();
  for (std::int64_t k = 0; k < rows * components; ++k)
  {
    column.values.push_back(make(static_cast<int>(k % components)));
  }
  (ofCells ? this->To.cellColumns : this->To.vertexColumns).push_back(column);
}

void ProblemMaker::addColumns()
{
  for (const bool ofCells : { false, true })
  {
    const std::string of = ofCells ? "c" : "v";
    this->addColumn(ofCells, (of + "One").c_str(), 1, false, [&](int) { return this->positive(); });
    this->addColumn(ofCells, (of + "All").c_str(), this->Columns, false,
      [&](int) { return this->uniform(-1, 1); });
    this->addColumn(
      ofCells, (of + "Tag").c_str(), 1, true, [&](int) { return this->Numbers.below(3); });
    this->addColumn(
      ofCells, (of + "Mask").c_str(), 1, true, [&](int) { return this->chance(0.2) ? 1 : 0; });
    this->addColumn(
      ofCells, (of + "Diagonal").c_str(), 3, false, [&](int) { return this->positive(); });
    // Diagonally dominant, so positive definite.
    this->addColumn(ofCells, (of + "Tensor").c_str(), 6, false,
      [&](int k) { return k < 3 ? this->uniform(1, 3) : this->uniform(-0.4, 0.4); });
  }
  this->addColumn(true, "field", this->chance(0.5) ? 3 : 3 * this->Columns, false,
    [&](int) { return this->uniform(-1, 1); });
}

double ProblemMaker::randomSet(GroupOf kind, double probability)
{
  MeshGroups& groups = this->To.groups;
  std::vector<std::uint32_t> set;
  for (std::size_t g = 0; g < groups.groups.size(); ++g)
  {
    if (groups.groups[g].of == kind && this->chance(probability))
    {
      set.push_back(static_cast<std::uint32_t>(g));
    }
  }
  const auto known = std::ranges::find(groups.sets, set);
  const auto number = known - groups.sets.begin();
  if (known == groups.sets.end())
  {
    groups.sets.push_back(set);
  }
  return static_cast<double>(number);
}

/** The same name and the same number may be those of several kinds. Of the cells of a facet, one
 * has its groups. */
void ProblemMaker::addGroups()
{
  if (this->chance(0.3))
  {
    return;
  }
  this->To.groups.groups = { { "v low", 1, GroupOf::Vertices }, { "both", 2, GroupOf::Vertices },
    { "f in", 1, GroupOf::Facets }, { "f out", 3, GroupOf::Facets },
    { "all three", {}, GroupOf::Facets }, { "c core", 1, GroupOf::Cells },
    { "both", 4, GroupOf::Cells }, { "all three", 5, GroupOf::Cells },
    { "all three", 6, GroupOf::Vertices } };
  this->addColumn(
    false, VertexGroupsName, 1, true, [&](int) { return this->randomSet(GroupOf::Vertices, 0.5); });
  this->addColumn(
    true, CellGroupsName, 1, true, [&](int) { return this->randomSet(GroupOf::Cells, 0.4); });
  const int size = cornersOf(this->To.type);
  std::set<std::vector<std::int64_t>> seen;
  std::int64_t facet = 0;
  this->addColumn(true, FacetGroupsName, size, true,
    [&](int k)
    {
      const std::int64_t* cell = this->To.cell(facet++ / size);
      std::vector<std::int64_t> corners(cell, cell + size);
      corners.erase(corners.begin() + k);
      std::ranges::sort(corners);
      return seen.insert(corners).second ? this->randomSet(GroupOf::Facets, 0.25) : 0.0;
    });
}

json ProblemMaker::group()
{
  switch (this->Numbers.below(4))
  {
    case 0:
      return { { "group", this->oneOf({ "v low", "c core", "f out", "f *", "*in", "all*" }) } };
    case 1:
      return { { "group", 1 + this->Numbers.below(5) } };
    case 2:
      return { { "group", { "both", this->oneOf({ "f in", "all three", "c core" }) } } };
    default:
      return { { "group", this->oneOf({ "both", "f in", "f in", "f out", "all three" }) } };
  }
}

json ProblemMaker::combination()
{
  json parts = { this->place(false), this->place(false) };
  const std::string key = this->oneOf({ "all", "any", "any", "not" });
  return { { key, key == "not" ? parts[0] : parts } };
}

json ProblemMaker::region()
{
  const double* p = this->somePoint();
  const double* q = this->somePoint();
  const double size = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  switch (this->Numbers.below(3))
  {
    case 0:
    {
      const double x = this->uniform(-1, 1), y = this->uniform(-1, 1), z = this->uniform(-1, 1);
      // Not through a vertex, where rounding would decide.
      const double at =
        x * p[0] + y * p[1] + z * p[2] + 1e-3 * this->someLength() * this->uniform(0.1, 1);
      return { { "halfspace", { x, y, z, at } } };
    }
    case 1:
      return { { "box", { std::min(p[0], q[0]), std::min(p[1], q[1]), std::min(p[2], q[2]),
                          std::max(p[0], q[0]), std::max(p[1], q[1]), std::max(p[2], q[2]) } } };
    default:
      return { { "sphere", { p[0], p[1], p[2], size * this->uniform(0.1, 0.9) } } };
  }
}

json ProblemMaker::place(bool mayBeEverywhere)
{
  if (!this->To.groups.empty() && this->chance(0.3))
  {
    return this->group();
  }
  if (this->chance(0.12))
  {
    return this->combination();
  }
  switch (this->Numbers.below(mayBeEverywhere ? 9 : 8))
  {
    case 0:
    {
      json ids = json::array();
      for (int k = 0; k < 3; ++k)
      {
        ids.push_back(this->Numbers.below(this->To.vertices()));
      }
      return { { "vertices", ids } };
    }
    case 1:
      return { { "tag", { this->oneOf({ "vTag", "cTag" }), this->Numbers.below(3) } } };
    case 2:
      return { { "mask", this->oneOf({ "vMask", "cMask" }) } };
    case 3:
    {
      json points = json::array();
      for (int k = 0; k < 2; ++k)
      {
        const double* p = this->somePoint();
        // Near a vertex: not halfway between two.
        points.push_back({ p[0] + 1e-7 * this->uniform(-1, 1), p[1], p[2] });
      }
      return { { "nearest", points } };
    }
    case 4:
      return { { "boundary", true } };
    case 8:
      return json::object();
    default:
      return this->region();
  }
}

json ProblemMaker::value(bool mayBeOfCells)
{
  const double form = this->uniform(0, 1);
  if (form < 0.4)
  {
    json numbers = json::array();
    for (int k = 0; k < this->Columns; ++k)
    {
      numbers.push_back(this->uniform(-1, 1));
    }
    return numbers;
  }
  if (form < 0.5 && this->Columns == 3)
  {
    return "position";
  }
  return mayBeOfCells ? this->oneOf({ "vAll", "cAll" }) : "vAll";
}

json ProblemMaker::coefficient(bool mayBeOfCells, bool mayBeZero)
{
  if (this->chance(0.4))
  {
    return mayBeZero && this->chance(0.2) ? 0.0 : this->positive();
  }
  return mayBeOfCells ? this->oneOf({ "vOne", "cOne" }) : "vOne";
}

json ProblemMaker::placed(const char* key, const json& value)
{
  json entry = this->place(false);
  entry[key] = value;
  return entry;
}

json ProblemMaker::datum(auto makeValue)
{
  if (this->chance(0.5))
  {
    return makeValue();
  }
  json entries = json::array();
  for (std::int64_t k = this->Numbers.below(3); k >= 0; --k)
  {
    json entry = this->place(true);
    entry["value"] = makeValue();
    entries.push_back(entry);
  }
  return entries;
}

json ProblemMaker::conductivity()
{
  return this->datum(
    [&]() -> json
    {
      const double form = this->uniform(0, 1);
      if (form < 0.25)
      {
        return this->positive();
      }
      if (form < 0.4)
      {
        return { this->uniform(1, 3), this->uniform(1, 3), this->uniform(1, 3),
          this->uniform(-0.4, 0.4), this->uniform(-0.4, 0.4), this->uniform(-0.4, 0.4) };
      }
      return this->oneOf(
        { "vOne", "cOne", "cOne", "vDiagonal", "cDiagonal", "vTensor", "cTensor" });
    });
}

void ProblemMaker::addRobin(json& problem)
{
  for (std::int64_t k = this->Numbers.below(2); k >= 0; --k)
  {
    json entry = this->placed("ambient", this->value(true));
    entry["coefficient"] = this->datum([&] { return this->coefficient(true, true); });
    problem["robin"].push_back(entry);
  }
}

void ProblemMaker::addSoft(json& problem)
{
  for (std::int64_t k = this->Numbers.below(2); k >= 0; --k)
  {
    json entry = this->placed("value", this->value(false));
    entry["weight"] = this->datum([&] { return this->coefficient(false, true); });
    problem["soft"].push_back(entry);
  }
}

json ProblemMaker::solve()
{
  json problem{ { "columns", this->Columns } };
  const bool isUniform = this->chance(0.08);
  if (isUniform)
  {
    problem["weights"] = "uniform";
  }
  else
  {
    problem["weights"] = this->chance(0.08) ? "clamped" : "cotangent";
    if (this->chance(0.6))
    {
      problem["conductivity"] = this->conductivity();
    }
    if (this->chance(0.3))
    {
      problem["field"] = "field";
    }
  }
  if (this->chance(0.3))
  {
    const bool inCells = this->chance(0.5);
    problem["screening"] = this->datum([&] { return this->coefficient(inCells, true); });
  }
  if (this->chance(0.5))
  {
    const bool inCells = this->chance(0.5);
    problem["source"] = this->datum([&] { return this->value(inCells); });
  }
  if (this->chance(0.2))
  {
    problem["initial"] = this->datum([&] { return this->value(false); });
  }
  for (int k = this->chance(0.8) ? 1 + static_cast<int>(this->Numbers.below(2)) : 0; k > 0; --k)
  {
    problem["dirichlet"].push_back(this->placed("value", this->value(false)));
  }
  for (int k = this->chance(0.3) ? 1 + static_cast<int>(this->Numbers.below(2)) : 0; k > 0; --k)
  {
    problem["flux"].push_back(this->placed("value", this->value(true)));
  }
  if (this->chance(0.3))
  {
    this->addRobin(problem);
  }
  if (this->chance(0.2))
  {
    this->addSoft(problem);
  }
  if (!problem.contains("dirichlet") && !problem.contains("source"))
  {
    problem["source"] = this->value(true);
  }
  problem["outputs"] = { "gradient", "flux" };
  if (this->chance(0.3))
  {
    problem["integrals"] = "*";
  }
  return problem;
}

} // namespace smg::testing
