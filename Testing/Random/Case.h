// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
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

/** How the problem of a case is solved; the result must not depend on most of it. */
struct CaseRun
{
  std::int64_t blockCells = 1000; ///< cells of a block of the stream
  int threads = 1;
  bool inCore = false;
  std::int64_t coreNodes = 50000, blockNodes = 4096;
  int sweeps = 2;
  int acceleration = 0;     ///< an AccelerationKind
  int cancelAt = 0;         ///< the call of the progress that ends a run with a checkpoint; 0: none
  std::string door = "c++"; ///< or "file": converted, and solved from the .vsm with its results
  std::string order = "keep"; ///< of a conversion
  bool isBinary = true;       ///< the .vtk file of a conversion
};

/**
 * A random problem: a mesh, numbered in stream order, the problem as the JSON of a problem file,
 * and a run. Kept in a JSON file, which repeats it.
 */
struct Case
{
  std::uint64_t seed = 0;
  CellType type = CellType::Triangle;
  std::vector<double> points;        ///< x, y, z a vertex
  std::vector<std::int64_t> corners; ///< of the cells
  std::vector<CaseColumn> vertexColumns, cellColumns;
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

/** The case of a seed. */
Case randomCase(std::uint64_t seed);

} // namespace smg::testing
