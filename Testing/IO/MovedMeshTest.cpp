// SPDX-License-Identifier: BSD-3-Clause
#include "smg/MovedMesh.h"

#include "IO/Formats/Vsm/WriteVsm.h"
#include "IO/Mesh/Columns.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/PrecisionSource.h"
#include "Testing/Support/TemporaryFolder.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

/** Positions in memory. */
class Positions : public Solution
{
public:
  explicit Positions(std::vector<double> values)
    : Values(std::move(values))
  {
  }
  std::int64_t vertices() const override
  {
    return static_cast<std::int64_t>(this->Values.size() / 3);
  }
  int columns() const override { return 3; }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    std::copy_n(this->Values.begin() + 3 * first, 3 * count, values.begin());
  }
  const smg::Report& report() const override { return this->Said; }

private:
  std::vector<double> Values;
  smg::Report Said;
};

class MovedMeshes : public ::testing::Test
{
protected:
  /** The mesh as a file, with columns of wrong normals and one of other vectors. */
  VsmReader& write(const IndexedTestMesh& indexed, bool doublePositions = true)
  {
    this->Mesh = toStream(indexed);
    const auto vertices = static_cast<std::size_t>(this->Mesh.vertices());
    const auto cells = static_cast<std::size_t>(this->Mesh.cells());
    const std::vector<float> wrong(3 * std::max(vertices, cells), 0.5F);
    const std::span<const float> all(wrong);
    this->Mesh.vertexColumns.push_back(makeColumn<float>(NormalsName, all.first(3 * vertices), 3));
    this->Mesh.vertexColumns.push_back(makeColumn<float>("Curvature", all.first(vertices)));
    this->Mesh.cellColumns.push_back(makeColumn<float>(NormalsName, all.first(3 * cells), 3));
    if (!doublePositions)
    {
      for (double& x : this->Mesh.positions)
      {
        x = static_cast<double>(static_cast<float>(x));
      }
    }
    PrecisionSource source(this->Mesh, 50, doublePositions);
    writeVsm(source, this->Folder / "mesh.vsm");
    this->Reader.emplace(this->Folder / "mesh.vsm");
    return *this->Reader;
  }

  static std::vector<std::string> names(const std::vector<ColumnSpec>& specs)
  {
    std::vector<std::string> names;
    for (const ColumnSpec& spec : specs)
    {
      names.push_back(spec.name);
    }
    return names;
  }

  TemporaryFolder Folder;
  StreamMesh Mesh;
  std::optional<VsmReader> Reader;
};

using Names = std::vector<std::string>;

} // namespace

TEST_F(MovedMeshes, HaveTheirPointsMovedAndTheirNormalsComputed)
{
  const VsmReader& reader = this->write(grid(6, 5, 0.05));
  // A flat lattice is turned upright.
  std::vector<double> moved = this->Mesh.positions;
  for (std::size_t i = 0; i < moved.size(); i += 3)
  {
    moved[i + 2] = 2 * moved[i + 1];
    moved[i + 1] = 0.25;
  }
  Positions positions(moved);
  const MovedMesh mesh(reader, positions, MovedNormals::Recompute);
  for (int time = 0; time < 2; ++time)
  {
    const auto source = mesh.source();
    const StreamInfo info = source->info();
    EXPECT_EQ(names(info.vertexColumns), (Names{ "Curvature", NormalsName }));
    EXPECT_EQ(names(info.cellColumns), Names{ NormalsName });
    const StreamMesh result = collect(*source);
    EXPECT_EQ(result.positions, moved);
    EXPECT_EQ(result.corners, this->Mesh.corners);
    EXPECT_EQ(result.vertexColumns[0].bytes, this->Mesh.vertexColumns[1].bytes);
    for (const Column& normals : { result.vertexColumns[1], result.cellColumns[0] })
    {
      for (std::size_t i = 0; i < normals.tuples(); ++i)
      {
        EXPECT_NEAR(normals.value(i, 0), 0.0, 1e-6);
        EXPECT_NEAR(normals.value(i, 1), -1.0, 1e-6);
        EXPECT_NEAR(normals.value(i, 2), 0.0, 1e-6);
      }
    }
  }
}

TEST_F(MovedMeshes, DropTheirNormals)
{
  const VsmReader& reader = this->write(grid(6, 5));
  Positions positions(this->Mesh.positions);
  const auto source = MovedMesh(reader, positions, MovedNormals::Drop).source();
  EXPECT_EQ(names(source->info().vertexColumns), Names{ "Curvature" });
  EXPECT_EQ(names(source->info().cellColumns), Names{});
  EXPECT_EQ(collect(*source).positions, this->Mesh.positions);
}

TEST_F(MovedMeshes, NeedPositionsOfThisMesh)
{
  const VsmReader& reader = this->write(grid(6, 5));
  Positions positions(std::vector<double>(this->Mesh.positions.size() - 3));
  const std::string message = messageOf([&] { MovedMesh(reader, positions, MovedNormals::Drop); });
  EXPECT_NE(message.find("a solution of 3 columns for"), std::string::npos) << message;
}

TEST_F(MovedMeshes, ComputeNormalsOfAnyType)
{
  StreamMesh mesh = toStream(grid(6, 5));
  const std::vector<std::int8_t> wrong(static_cast<std::size_t>(3 * mesh.vertices()), 100);
  mesh.vertexColumns.push_back(makeColumn<std::int8_t>(NormalsName, wrong, 3));
  MemorySource memory(mesh, 50);
  writeVsm(memory, this->Folder / "mesh.vsm");
  const VsmReader reader(this->Folder / "mesh.vsm");
  Positions positions(mesh.positions);
  const StreamMesh result =
    collect(*MovedMesh(reader, positions, MovedNormals::Recompute).source());
  ASSERT_EQ(result.vertexColumns.size(), 1u);
  EXPECT_EQ(result.vertexColumns[0].spec, (ColumnSpec{ NormalsName, ScalarType::Float32, 3 }));
  EXPECT_NEAR(std::abs(result.vertexColumns[0].value(7, 2)), 1.0, 1e-6);
  EXPECT_EQ(names(MovedMesh(reader, positions, MovedNormals::Drop).source()->info().vertexColumns),
    Names{});
}

TEST_F(MovedMeshes, OfTetrahedraHaveNoNormals)
{
  const VsmReader& reader = this->write(tetBox(3, 3, 3));
  Positions positions(this->Mesh.positions);
  const auto source = MovedMesh(reader, positions, MovedNormals::Recompute).source();
  EXPECT_EQ(names(source->info().vertexColumns), Names{ "Curvature" });
  EXPECT_EQ(names(source->info().cellColumns), Names{});
}

TEST_F(MovedMeshes, KeepTheirPrecision)
{
  const VsmReader& reader = this->write(grid(6, 5), false);
  std::vector<double> moved = this->Mesh.positions;
  for (double& x : moved)
  {
    x += 0.1;
  }
  Positions positions(moved);
  const auto source = MovedMesh(reader, positions, MovedNormals::Drop).source();
  EXPECT_FALSE(source->info().doublePositions);
  const StreamMesh result = collect(*source);
  for (std::size_t i = 0; i < moved.size(); ++i)
  {
    EXPECT_EQ(result.positions[i], static_cast<double>(static_cast<float>(moved[i])));
  }
  moved[3 * 7 + 1] = 1e39;
  Positions far(moved);
  expectError([&] { collect(*MovedMesh(reader, far, MovedNormals::Drop).source()); },
    "The moved mesh: coordinate 1 of vertex 7 ");
}

} // namespace smg::testing
