// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Format.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace smg::testing
{

/** The volumes of tetrahedra, negative if they are inverted. */
inline std::vector<double> tetrahedronVolumes(const ReadMesh& mesh)
{
  std::vector<double> volumes;
  for (std::size_t i = 0; i + 3 < mesh.corners.size(); i += 4)
  {
    double e[3][3];
    for (std::size_t k = 0; k < 3; ++k)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        e[k][axis] = mesh.positions[3 * std::size_t(mesh.corners[i + k + 1]) + axis] -
                     mesh.positions[3 * std::size_t(mesh.corners[i]) + axis];
      }
    }
    volumes.push_back((e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                        e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                        e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
                      6);
  }
  return volumes;
}

/** Twelve points of a unit cube, a pyramid next to it, a prism on it and a tetrahedron in front of
 * the prism: convex, with a total volume of 2. */
inline const std::vector<std::array<double, 3>> FourSolidsPoints{ { 0, 0, 0 }, { 1, 0, 0 },
  { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 }, { 2, 0.5, 0.5 },
  { 0.5, 0, 2 }, { 0.5, 1, 2 }, { 0.5, -1, 1.25 } };
/** Their corners. The first triangle of the prism faces inwards: the order of Gmsh and Medit. */
inline const std::vector<std::vector<std::int64_t>> FourSolids{ { 0, 1, 2, 3, 4, 5, 6, 7 },
  { 1, 2, 6, 5, 8 }, { 4, 9, 5, 7, 10, 6 }, { 4, 5, 9, 11 } };

inline void expectFourSolids(const ReadMesh& mesh)
{
  EXPECT_EQ(mesh.cellType, CellType::Tetrahedron);
  EXPECT_EQ(mesh.cells(), 6 + 2 + 3 + 1);
  EXPECT_EQ(mesh.counts.splitCells, 3);
  std::vector<double> elementVolumes(4);
  const std::vector<double> volumes = tetrahedronVolumes(mesh);
  for (std::size_t cell = 0; cell < volumes.size(); ++cell)
  {
    EXPECT_GT(volumes[cell], 0) << "cell " << cell << " is turned over";
    elementVolumes.at(static_cast<std::size_t>(mesh.elements[cell])) += volumes[cell];
  }
  constexpr double expected[] = { 1.0, 1.0 / 3, 0.5, 1.0 / 6 };
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_NEAR(elementVolumes[i], expected[i], 1e-14) << "element " << i;
  }
}

/** Parses files that it writes to its own folder. */
class VolumeImport : public ::testing::Test
{
protected:
  /** Imports the file of this name, which exists. */
  ReadMesh readFile(
    const Format& format, const std::filesystem::path& path, CellChoice choice = CellChoice::Only)
  {
    InputFile file(path);
    RawMeshBuilder builder(this->Space, choice);
    format.parse(file, builder, {}, {});
    try
    {
      return readRaw(builder.finish());
    }
    catch (const MeshError& error)
    {
      throw Error(error.what());
    }
  }

  void write(const std::string& name, std::string_view bytes)
  {
    // Some systems write an overwritten file to the disk at once, which is slow.
    std::filesystem::remove(this->Folder / name);
    writeBytes(this->Folder / name, bytes);
  }

  ReadMesh read(const Format& format, const std::string& name, std::string_view bytes,
    CellChoice choice = CellChoice::Only)
  {
    this->write(name, bytes);
    return this->readFile(format, this->Folder / name, choice);
  }

  /** Damages the file in many ways: each time it must be read as a valid mesh, or refused. */
  void expectSafe(const Format& format, const std::string& name, const std::string& bytes)
  {
    for (std::size_t length = 0; length < bytes.size(); ++length)
    {
      this->attempt(format, name, bytes.substr(0, length));
    }
    Random random(7);
    for (int i = 0; i < 400; ++i)
    {
      std::string damaged = bytes;
      for (int k = 0; k < 1 + i % 4; ++k)
      {
        const auto place =
          static_cast<std::size_t>(random.below(static_cast<std::int64_t>(damaged.size())));
        damaged[place] = i % 3 == 0   ? static_cast<char>(damaged[place] ^ (1 << random.below(8)))
                         : i % 3 == 1 ? static_cast<char>(random.below(256))
                                      : "0123456789-.e \n$"[random.below(16)];
      }
      this->attempt(format, name, damaged);
    }
    this->write(name, bytes);
  }

  TemporaryFolder Folder;
  Workspace Space{ this->Folder.path(), Workspace::MinMemory };

private:
  void attempt(const Format& format, const std::string& name, const std::string& bytes)
  {
    try
    {
      expectValid(this->read(format, name, bytes));
    }
    catch (const Error& error)
    {
      ASSERT_STRNE(error.what(), "");
    }
    ASSERT_EQ(this->Space.pool().used(), 0);
  }
};

} // namespace smg::testing
