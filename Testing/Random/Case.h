// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"
#include "smg/Groups.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace smg::testing
{

/** A column of a random mesh: numbers of the vertices or cells. */
struct CaseColumn
{
  std::string name;
  int components = 1;
  std::vector<double> values;
  bool isInteger = false; ///< stored as int32: a tag or a mask
};

/** How a case is solved; the result must not depend on most of it. */
struct CaseRun
{
  std::int64_t blockCells = 1000; ///< cells of a block of the stream
  int threads = 1;
  bool inCore = false;
  std::int64_t coreNodes = 50000, blockNodes = 4096;
  int sweeps = 2;
  int acceleration = 0;  ///< an AccelerationKind
  int cancelAt = 0;      ///< the call of the progress that ends a run with a checkpoint; 0: none
  bool isKilled = false; ///< it ends in a process of its own, which is killed
  double memory = 0.0;   ///< the limit, as a share of what a run without one takes; 0: none
  std::string door =
    "c++"; ///< "file": converted, solved from the .vsm with results; "vtk": a filter
  std::string order = "keep"; ///< of a conversion
  int unused = 0;             ///< vertices of no cell at the end of the file
  int pieces = 1;             ///< that the filter pulls
  std::string relation;       ///< see Relations.h; empty: none
};

/**
 * A random problem: a mesh, numbered in stream order, what is asked as JSON, and a run. Kept in a
 * JSON file, which repeats it.
 *
 *     job         problem
 *     solve       a problem file
 *     deform      a handle file
 *     smooth      { "size": in the unit of the mesh, "steps", "hold": [ WHERE ],
 *                   "boundary": "smooth" | "fixed" | "free", "keepVolume": bool, "column": name }
 *     distance    { "from": [ WHERE ], "wall": bool }
 *     blend       { "patch": name, "columns": [ name ], "hold": [ WHERE ], "anchor",
 *                   "seam": "zero" | "average" }
 */
struct Case
{
  std::uint64_t seed = 0;
  std::string job = "solve";
  CellType type = CellType::Triangle;
  std::vector<double> points;        ///< x, y, z a vertex
  std::vector<std::int64_t> corners; ///< of the cells
  std::vector<CaseColumn> vertexColumns, cellColumns;
  MeshGroups groups; ///< with columns of their sets
  nlohmann::json problem;
  CaseRun run;

  std::int64_t vertices() const { return static_cast<std::int64_t>(this->points.size() / 3); }
  std::int64_t cells() const
  {
    return static_cast<std::int64_t>(this->corners.size()) / cornersOf(this->type);
  }
  const std::int64_t* cell(std::int64_t c) const
  {
    return this->corners.data() + c * cornersOf(this->type);
  }

  /** The cells that have no weight: CellFlag bits, found by comparing all cells. */
  std::vector<std::uint8_t> flags() const;
  /** As a mesh stream, with its flags. */
  StreamMesh stream() const;
  /** Without some cells (1: kept), and without the vertices that no cell uses then. */
  Case part(const std::vector<std::uint8_t>& kept) const;
  /** A legacy VTK file with all columns. */
  void writeVtk(const std::filesystem::path& path) const;

  void save(const std::filesystem::path& path) const;
  static Case load(const std::filesystem::path& path);
};

/** A random mesh of at most about 1500 cells; its cells are in any order. */
IndexedTestMesh randomMesh(Random& random);

/** The case of a seed: a solve for most of them. */
Case randomCase(std::uint64_t seed);

/** What makes random problems on a mesh, and its columns. */
class ProblemMaker
{
public:
  ProblemMaker(Case& to, Random& random);

  /** Names begin with v for vertices and c for cells. */
  void addColumns();
  /** Groups of vertices, facets and cells, with columns of their sets; mostly. */
  void addGroups();
  nlohmann::json solve();
  /** Replaces the mesh by one with sides that match, and couples them: periodic, or by a contact.
   */
  void coupleSides();
  /** The other data of such a problem. */
  void addCoupledData();
  nlohmann::json deform();
  nlohmann::json smooth();
  nlohmann::json distance();
  nlohmann::json blend();

private:
  double uniform(double low, double high) { return this->Numbers.uniform(low, high); }
  bool chance(double probability) { return this->Numbers.uniform() < probability; }
  double positive() { return std::pow(10, this->uniform(-this->Contrast, this->Contrast)); }
  std::string oneOf(std::initializer_list<const char*> names)
  {
    return names.begin()[this->Numbers.below(static_cast<std::int64_t>(names.size()))];
  }
  const double* somePoint()
  {
    return &this->To.points[3 * static_cast<std::size_t>(this->Numbers.below(this->To.vertices()))];
  }
  /** A length of the mesh: between two of its points. */
  double someLength();

  void addColumn(bool ofCells, const char* name, int components, bool isInteger, auto make);
  /** A place, as members of an object; empty: everywhere. */
  nlohmann::json place(bool mayBeEverywhere);
  nlohmann::json places();
  nlohmann::json region();
  nlohmann::json group();
  nlohmann::json combination();
  /** The set of a random choice of the groups of a kind, each with this probability. */
  double randomSet(GroupOf kind, double probability);
  nlohmann::json value(bool mayBeOfCells);
  nlohmann::json coefficient(bool mayBeOfCells, bool mayBeZero);
  /** A coefficient or a list of placed ones. */
  nlohmann::json datum(auto makeValue);
  nlohmann::json conductivity();
  nlohmann::json placed(const char* key, const nlohmann::json& value);
  nlohmann::json motion();
  void addRobin(nlohmann::json& problem);
  void addSoft(nlohmann::json& problem);

  Case& To;
  Random& Numbers;
  int Columns;
  double Contrast;
  std::vector<std::int64_t> Inside; ///< vertices of the first body, none on a side
};

} // namespace smg::testing
