// SPDX-License-Identifier: BSD-3-Clause
/*
The hierarchy that a solve builds, written as a table, in C++ without VTK.

What this lesson shows:
 1. An operator set may look at what another one does: this one is the default set, and notes each
    row of the interpolation P when it is final, together with the row of the matrix.
 2. What the hierarchy is: a C-point has a coarse node of its own; the row of P of any other node
    says from which coarse nodes it takes how much.
 3. Nodes of the finest level are the vertices, in stream order. Those of a coarse level are in the
    order of their C-points: so each level is a stream like the mesh.

Run it:

    hierarchy ../../Data/bunny.smb bunny-hierarchy.csv

    34834 vertices, 4 levels
    level 0: 34834 nodes, 0.39 of them C-points, 2.0 entries in a row of P
    level 1: 13722 nodes, 0.25 of them C-points, 3.2 entries in a row of P
    level 2: 3441 nodes, 0.24 of them C-points, 3.3 entries in a row of P

The table has the columns level, node, relation, other, weight. Relation "edge": other is a
neighbour on the level, and the weight that of the edge. "C-point": other is the coarse node of the
node. "takes": other is a coarse node from which the node takes the weight.
*/

#include <smg/Convert.h>
#include <smg/SolveWith.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <vector>

/** What was noted of a level. */
struct Noted
{
  std::int64_t nodes = 0, coarse = 0, entries = 0;
};

/** The table, and what it has. */
struct Notes
{
  std::ofstream table;
  std::vector<Noted> levels;
  std::map<const smg::CoarseningData*, std::size_t> levelOf;

  /** The level of a row that is noted: a level begins with node 0, after the finer one has. */
  std::size_t levelAt(const smg::CoarseningData& data, std::int64_t node)
  {
    if (node == 0)
    {
      this->levelOf[&data] = this->levels.size();
      this->levels.emplace_back();
    }
    return this->levelOf.at(&data);
  }
};

/** The default operator set, which notes the rows. Its steps run on one thread, since it declares
 * no alias Apart. */
struct Recorded : smg::Extended
{
  static constexpr const char* name = "recorded";
  static Recorded forCells(smg::CellType type) { return { Extended::forCells(type) }; }
  static inline Notes* notes = nullptr;

  void interpolate(smg::CoarseningData& data, std::int64_t i) const
  {
    Extended::interpolate(data, i);
    const std::size_t l = notes->levelAt(data, i);
    Noted& level = notes->levels[l];
    ++level.nodes;
    const auto note = [&](const char* relation, std::int64_t other, float weight)
    { notes->table << l << ',' << i << ',' << relation << ',' << other << ',' << weight << '\n'; };
    for (const smg::RowEntry& entry : data.fine.row(i))
    {
      note("edge", i + entry.delta(), entry.weight());
    }
    const bool isCPoint = data.coarseIndex[i] != smg::CoarseningData::FPoint;
    const smg::InterpolationEntry* row = data.interpolation.row(i);
    for (std::int64_t e = 0; e < data.interpolation.size(i); ++e)
    {
      const std::int64_t near = data.publishedCoarse;
      note(isCPoint ? "C-point" : "takes", near + row[e].offset(near), row[e].weight());
    }
    level.entries += data.interpolation.size(i);
    level.coarse += isCPoint ? 1 : 0;
  }
};

/** 0 at the feet of the bunny, 1 at the tips of its ears. */
struct FeetAndEars : smg::Problem
{
  int columns() const override { return 1; }
  void conditions(const smg::MeshBlock& block, smg::VertexConditions& conditions) override
  {
    for (std::int64_t i = 0; i < block.vertices(); ++i)
    {
      const double height = block.positions[3 * i + 1]; // metres
      conditions.dirichlet[i] = height < 0.036 || height > 0.18 ? 0 : -1;
      conditions.value[i] = height > 0.18 ? 1.0 : 0.0;
    }
  }
};

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: hierarchy MESH TABLE.csv\n";
    return 2;
  }
  try
  {
    Notes notes{ std::ofstream(argv[2]), {}, {} };
    notes.table << "level,node,relation,other,weight\n";
    Recorded::notes = &notes;
    const auto mesh = smg::openMesh(argv[1]);
    FeetAndEars problem;
    const auto solution =
      smg::solveWith<Recorded>(*mesh->source({}, {}), problem, { .inCore = true });
    const smg::Report& report = solution->report();
    std::printf(
      "%lld vertices, %zu levels\n", static_cast<long long>(report.vertices), report.levels.size());
    for (std::size_t l = 0; l + 1 < report.levels.size(); ++l)
    {
      const Noted& level = notes.levels[l];
      const auto nodes = static_cast<double>(level.nodes);
      std::printf("level %zu: %lld nodes, %.2f of them C-points, %.1f entries in a row of P\n", l,
        static_cast<long long>(level.nodes), static_cast<double>(level.coarse) / nodes,
        static_cast<double>(level.entries) / nodes);
    }
    if (!notes.table.flush())
    {
      throw smg::Error(std::string(argv[2]) + " cannot be written");
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
