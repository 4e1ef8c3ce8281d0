// SPDX-License-Identifier: BSD-3-Clause
// Random cases: the mesh, one of the jobs with what it is asked, and the run.
#include "Testing/Random/Case.h"
#include "Testing/Random/Oracle.h"

#include <algorithm>

namespace smg::testing
{

using nlohmann::json;

json ProblemMaker::places()
{
  json places = json::array();
  for (std::int64_t k = this->Numbers.below(2); k >= 0; --k)
  {
    places.push_back(this->place(false));
  }
  return places;
}

/** Fixed, a similarity, or a target of each vertex. */
json ProblemMaker::motion()
{
  const double form = this->uniform(0, 1);
  if (form < 0.3)
  {
    return { { "fixed", true } };
  }
  const double* p = this->somePoint();
  const double length = this->someLength();
  const auto vector = [&](double size)
  {
    return json{ size * this->uniform(-1, 1), size * this->uniform(-1, 1),
      size * this->uniform(-1, 1) };
  };
  if (form < 0.45)
  {
    return { { "target", this->chance(0.5) ? json("position") : vector(length) },
      { "rotation", vector(2) }, { "logScale", this->uniform(-1, 1) } };
  }
  json motion{ { "translate", vector(length) } };
  if (this->chance(0.7))
  {
    motion["center"] = { p[0], p[1], p[2] };
    motion["rotate"] = { { "axis", vector(1) }, { "degrees", this->uniform(-200, 200) } };
  }
  if (this->chance(0.4))
  {
    motion["center"] = { p[0], p[1], p[2] };
    motion["scale"] = this->uniform(0.5, 2);
  }
  return motion;
}

json ProblemMaker::deform()
{
  json handles = json::array();
  const bool isCommon = this->chance(0.3);
  const json common = this->motion();
  for (std::int64_t k = 1 + this->Numbers.below(2); k >= 0; --k)
  {
    json handle = isCommon ? common : this->motion();
    handle["region"] = this->place(false);
    handles.push_back(handle);
  }
  return { { "handles", handles },
    { "weights", this->oneOf({ "clamped", "clamped", "cotangent", "uniform" }) } };
}

json ProblemMaker::smooth()
{
  json asked{ { "size", this->someLength() * this->uniform(0.05, 1) },
    { "steps", 1 + this->Numbers.below(3) }, { "hold", json::array() }, { "keepVolume", false },
    { "boundary", this->oneOf({ "fixed", "free" }) }, { "column", "" } };
  if (this->chance(0.4))
  {
    asked["hold"] = this->places();
  }
  if (this->To.type == CellType::Tetrahedron || this->chance(0.4))
  {
    asked["column"] = this->oneOf({ "vOne", "vAll", "vTag", "vTensor" });
  }
  else if (this->chance(0.3))
  {
    asked["boundary"] = "smooth";
    asked["keepVolume"] = true;
  }
  return asked;
}

json ProblemMaker::distance()
{
  const bool isWall = this->To.type == CellType::Tetrahedron && this->chance(0.5);
  return { { "wall", isWall },
    { "from", isWall && this->chance(0.5) ? json::array() : this->places() } };
}

json ProblemMaker::blend()
{
  return { { "patch", this->oneOf({ "vTag", "cTag", "vMask", "cMask" }) },
    { "columns", { this->oneOf({ "vAll", "vOne", "vDiagonal" }) } },
    { "hold", this->chance(0.4) ? this->places() : json::array() },
    { "anchor", this->chance(0.3) ? 0.0 : this->positive() },
    { "seam", this->oneOf({ "zero", "average" }) } };
}

namespace
{

std::string randomJob(Random& random)
{
  const double form = random.uniform();
  return form < 0.6   ? "solve"
         : form < 0.7 ? "deform"
         : form < 0.8 ? "smooth"
         : form < 0.9 ? "distance"
                      : "blend";
}

CaseRun randomRun(Random& random, const std::string& job)
{
  const auto oneOf = [&random](std::initializer_list<std::int64_t> numbers)
  { return numbers.begin()[random.below(static_cast<std::int64_t>(numbers.size()))]; };
  CaseRun run;
  run.blockCells = oneOf({ 1, 1, 2, 3, 7, 40, 300, 1000000 });
  run.threads = static_cast<int>(oneOf({ 1, 2, 3 }));
  run.inCore = random.uniform() < 0.2;
  run.coreNodes = oneOf({ 0, 5, 30, 50000 });
  run.blockNodes = oneOf({ 1, 3, 16, 100, 4096 });
  run.sweeps = static_cast<int>(oneOf({ 1, 2, 2, 3 }));
  run.acceleration = static_cast<int>(random.below(4));
  if (job != "solve")
  {
    return run;
  }
  const double form = random.uniform();
  const char* const orders[] = { "bfs", "keep", "axis" };
  run.order = orders[random.below(3)];
  run.unused = static_cast<int>(random.below(3));
  run.pieces = static_cast<int>(oneOf({ 1, 2, 3, 7 }));
  if (form < 0.15)
  {
    run.door = "file";
  }
  else if (form < 0.3)
  {
    // Where there is no VTK, from memory.
    run.door = "vtk";
    run.coreNodes = CaseRun().coreNodes;
    run.blockNodes = CaseRun().blockNodes;
  }
  else if (form < 0.6)
  {
    const char* const relations[] = { "linear", "scaled", "shifted", "permuted", "turned" };
    run.relation = relations[random.below(5)];
  }
  else if (form < 0.8 && !run.inCore)
  {
    run.cancelAt = 1 + static_cast<int>(random.below(30));
    run.isKilled = random.uniform() < 0.2;
  }
  else if (form < 0.9)
  {
    run.memory = random.uniform(0.1, 1.2);
  }
  return run;
}

} // namespace

Case randomCase(std::uint64_t seed)
{
  Random random(seed * 2654435761U + 12345);
  for (int k = 0; k < 3; ++k)
  {
    random.bits();
  }
  Case made;
  made.seed = seed;
  const IndexedTestMesh mesh = randomMesh(random);
  // Numbered by first use, as in a stream; unused vertices are left out.
  made.type = mesh.cellType;
  made.points = mesh.positions;
  made.corners = mesh.corners;
  made = made.part(std::vector<std::uint8_t>(static_cast<std::size_t>(made.cells()), 1));
  ProblemMaker maker(made, random);
  maker.addColumns();
  maker.addGroups();
  made.job = randomJob(random);
  if (made.job == "solve")
  {
    // Some problems select nothing: that is an error, which is tested enough by a few.
    const double patience = random.uniform(0, 5);
    int tries = 0;
    do
    {
      made.problem = maker.solve();
    } while (++tries < patience && !Oracle(made).refusal.empty());
  }
  else
  {
    made.problem = made.job == "deform"     ? maker.deform()
                   : made.job == "smooth"   ? maker.smooth()
                   : made.job == "distance" ? maker.distance()
                                            : maker.blend();
  }
  made.run = randomRun(random, made.job);
  if (made.job == "solve" && random.uniform() < 0.12)
  {
    maker.coupleSides();
    maker.addCoupledData();
  }
  return made;
}

} // namespace smg::testing
