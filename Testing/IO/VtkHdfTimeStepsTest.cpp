// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/VtkHdf/Hdf5/Hdf5Output.h"
#include "Testing/IO/HdfFile.h"
#include "Testing/IO/ImportFixture.h"
#include "Testing/Support/ErrorMessage.h"

#include <array>
#include <functional>
#include <limits>
#include <span>
#include <utility>

namespace smg::testing
{
namespace
{

/** The cells of one kind in a partition. */
struct CellsOfKind
{
  std::vector<std::int64_t> points, ends{ 0 };

  void add(std::initializer_list<std::int64_t> cell)
  {
    this->points.insert(this->points.end(), cell);
    this->ends.push_back(static_cast<std::int64_t>(this->points.size()));
  }
  std::int64_t cells() const { return static_cast<std::int64_t>(this->ends.size()) - 1; }
};

constexpr std::array<const char*, 4> CellKinds{ "Vertices", "Lines", "Polygons", "Strips" };

/** A partition of polygonal data. */
struct PolyPart
{
  std::vector<float> points;
  std::array<CellsOfKind, CellKinds.size()> kinds;
};

using PolyStep = std::vector<PolyPart>;

/** A partition with these numbers of polygons and strips; its points have the height. */
PolyPart partOf(int polygons, int strips, float height)
{
  PolyPart part;
  const int points = 3 + polygons + strips;
  for (int i = 0; i < points; ++i)
  {
    part.points.insert(
      part.points.end(), { static_cast<float>(i), static_cast<float>(i * i), height });
  }
  for (int i = 0; i < polygons; ++i)
  {
    part.kinds[2].add({ i, i + 1, i + 2 });
  }
  for (int i = polygons; i < polygons + strips; ++i)
  {
    part.kinds[3].add({ i + 2, i + 1, i });
  }
  return part;
}

/** Writes polygonal data; if `cellsStay`, all steps have the cells of the first. */
class PolyFile
{
public:
  PolyFile(const std::filesystem::path& path, const std::vector<PolyStep>& steps, bool cellsStay,
    bool hasSteps = true, const std::vector<double>& times = {})
    : Out(path)
  {
    this->Out.addGroup("/VTKHDF");
    this->Out.addText("/VTKHDF", "Type", "PolyData");
    this->Out.addIntegers("/VTKHDF", "Version", std::vector<std::int64_t>{ 2, 0 });
    this->writePoints(steps);
    std::vector<std::int64_t> cellOffsets(steps.size() * CellKinds.size());
    std::vector<std::int64_t> idOffsets(cellOffsets.size());
    for (std::size_t kind = 0; kind < CellKinds.size(); ++kind)
    {
      this->writeKind(steps, kind, cellsStay, cellOffsets, idOffsets);
    }
    if (hasSteps)
    {
      this->Out.addIntegers("/VTKHDF/Steps", "NSteps",
        std::vector<std::int64_t>{ static_cast<std::int64_t>(steps.size()) });
      if (!times.empty())
      {
        this->add("Steps/Values", ScalarType::Float64, 0, times);
      }
      this->add("Steps/CellOffsets", ScalarType::Int64, 4, cellOffsets);
      this->add("Steps/ConnectivityIdOffsets", ScalarType::Int64, 4, idOffsets);
    }
    this->Out.finish();
  }

private:
  template <class T>
  void add(const std::string& name, ScalarType type, int components, const std::vector<T>& values)
  {
    this->Out.addDataset("/VTKHDF/" + name, type, components);
    this->Out.append("/VTKHDF/" + name, std::span<const T>(values));
  }

  void writePoints(const std::vector<PolyStep>& steps)
  {
    std::vector<std::int64_t> counts, partOffsets, partCounts, pointOffsets;
    std::vector<float> points;
    for (const PolyStep& step : steps)
    {
      partOffsets.push_back(static_cast<std::int64_t>(counts.size()));
      partCounts.push_back(static_cast<std::int64_t>(step.size()));
      pointOffsets.push_back(static_cast<std::int64_t>(points.size() / 3));
      for (const PolyPart& part : step)
      {
        counts.push_back(static_cast<std::int64_t>(part.points.size() / 3));
        points.insert(points.end(), part.points.begin(), part.points.end());
      }
    }
    this->add("NumberOfPoints", ScalarType::Int64, 0, counts);
    this->add("Points", ScalarType::Float32, 3, points);
    this->Out.addGroup("/VTKHDF/Steps");
    this->add("Steps/PartOffsets", ScalarType::Int64, 0, partOffsets);
    this->add("Steps/NumberOfParts", ScalarType::Int64, 0, partCounts);
    this->add("Steps/PointOffsets", ScalarType::Int64, 0, pointOffsets);
  }

  void writeKind(const std::vector<PolyStep>& steps, std::size_t kind, bool cellsStay,
    std::vector<std::int64_t>& cellOffsets, std::vector<std::int64_t>& idOffsets)
  {
    std::vector<std::int64_t> cells, ids, points, ends;
    std::int64_t written = 0;
    for (std::size_t step = 0; step < steps.size(); ++step)
    {
      const bool stays = cellsStay && step > 0;
      cellOffsets[step * CellKinds.size() + kind] = stays ? 0 : written;
      idOffsets[step * CellKinds.size() + kind] =
        stays ? 0 : static_cast<std::int64_t>(points.size());
      for (const PolyPart& part : steps[step])
      {
        const CellsOfKind& own = part.kinds[kind];
        cells.push_back(own.cells());
        ids.push_back(static_cast<std::int64_t>(own.points.size()));
        if (!stays)
        {
          written += own.cells();
          points.insert(points.end(), own.points.begin(), own.points.end());
          ends.insert(ends.end(), own.ends.begin(), own.ends.end());
        }
      }
    }
    const std::string group = CellKinds[kind];
    this->Out.addGroup("/VTKHDF/" + group);
    this->add(group + "/NumberOfCells", ScalarType::Int64, 0, cells);
    this->add(group + "/NumberOfConnectivityIds", ScalarType::Int64, 0, ids);
    this->add(group + "/Connectivity", ScalarType::Int64, 0, points);
    this->add(group + "/Offsets", ScalarType::Int64, 0, ends);
  }

  Hdf5Output Out;
};

/** What an unstructured grid of three time steps stores once for all of them. */
struct Stays
{
  bool points, counts;
};
constexpr std::int64_t GridSteps = 3, GridParts = 2;

/** Partition p has 4 + p points, at the height of the step if they move, and 2 + p triangles around
 * the first one, always the same; the column Step is the number of the step. */
void writeGrid(const std::filesystem::path& path, const Stays& stays)
{
  std::vector<float> points, values;
  std::vector<std::int64_t> counts, cells, ids, corners, ends, parts, own, pointOffsets, zeros;
  std::vector<std::int64_t> valueOffsets;
  for (std::int64_t step = 0; step < GridSteps; ++step)
  {
    parts.push_back(stays.counts ? 0 : step * GridParts);
    own.push_back(GridParts);
    zeros.push_back(0);
    pointOffsets.push_back(stays.points ? 0 : static_cast<std::int64_t>(points.size() / 3));
    valueOffsets.push_back(static_cast<std::int64_t>(values.size()));
    for (std::int64_t part = 0; part < GridParts; ++part)
    {
      values.insert(values.end(), static_cast<std::size_t>(4 + part), static_cast<float>(step));
      for (int i = 0; i < 4 + part && (step == 0 || !stays.points); ++i)
      {
        points.insert(points.end(), { static_cast<float>(i), static_cast<float>(i * i),
                                      static_cast<float>(stays.points ? 0 : step) });
      }
      if (step == 0 || !stays.counts)
      {
        counts.push_back(4 + part);
        cells.push_back(2 + part);
        ids.push_back(3 * (2 + part));
      }
      for (std::int64_t cell = 0; cell < 2 + part && step == 0; ++cell)
      {
        corners.insert(corners.end(), { 0, cell + 1, cell + 2 });
      }
      for (std::int64_t end = 0; end <= 2 + part && step == 0; ++end)
      {
        ends.push_back(3 * end);
      }
    }
  }
  HdfFile file(path, "UnstructuredGrid");
  const auto add = [&file](
                     const std::string& name, ScalarType type, int components, const auto& all)
  {
    file.out().addDataset("/VTKHDF/" + name, type, components);
    file.out().append("/VTKHDF/" + name, std::span(all));
  };
  for (const char* group : { "PointData", "Steps", "Steps/PointDataOffsets" })
  {
    file.group(group);
  }
  add("Points", ScalarType::Float32, 3, points);
  add("PointData/Step", ScalarType::Float32, 0, values);
  add("Types", ScalarType::UInt8, 0, std::vector<std::uint8_t>(corners.size() / 3, 5));
  const std::pair<const char*, const std::vector<std::int64_t>&> lists[] = { { "NumberOfPoints",
                                                                               counts },
    { "NumberOfCells", cells }, { "NumberOfConnectivityIds", ids }, { "Connectivity", corners },
    { "Offsets", ends }, { "Steps/PartOffsets", parts }, { "Steps/NumberOfParts", own },
    { "Steps/PointOffsets", pointOffsets }, { "Steps/CellOffsets", zeros },
    { "Steps/ConnectivityIdOffsets", zeros }, { "Steps/PointDataOffsets/Step", valueOffsets } };
  for (const auto& [name, numbers] : lists)
  {
    add(name, ScalarType::Int64, 0, numbers);
  }
  file.out().addIntegers("/VTKHDF/Steps", "NSteps", std::vector<std::int64_t>{ GridSteps });
  file.finish();
}

class VtkHdfTimeSteps : public ImportFixture
{
protected:
  ReadMesh readStep(const std::string& name, std::int64_t step, std::optional<std::int64_t> part)
  {
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    ImportOptions options;
    options.part = { step, part };
    return readRaw(importMesh(this->Folder / name, workspace, options));
  }

  /** Expects each step, whole and by partition, to be read as from a file of that step alone. */
  void expectSteps(const std::vector<PolyStep>& steps, bool cellsStay)
  {
    PolyFile(this->Folder / "steps.vtkhdf", steps, cellsStay);
    for (std::size_t step = 0; step < steps.size(); ++step)
    {
      PolyFile(this->Folder / "one.vtkhdf", { steps[step] }, false, false);
      std::vector<std::optional<std::int64_t>> parts{ std::nullopt };
      for (std::size_t part = 0; part < steps[step].size(); ++part)
      {
        parts.emplace_back(static_cast<std::int64_t>(part));
      }
      for (const auto& part : parts)
      {
        const auto at = static_cast<std::int64_t>(step);
        const ReadMesh mesh = this->readStep("steps.vtkhdf", at, part);
        const ReadMesh one = this->readStep("one.vtkhdf", 0, part);
        EXPECT_EQ(mesh.positions, one.positions) << step << ' ' << part.value_or(-1);
        EXPECT_EQ(mesh.corners, one.corners) << step << ' ' << part.value_or(-1);
      }
    }
  }
};

/** Steps of three partitions, each of at least one cell; `polygons` and `strips` by partition. */
std::vector<PolyStep> stepsOf(std::size_t count,
  const std::function<int(std::size_t, int)>& polygons,
  const std::function<int(std::size_t, int)>& strips)
{
  std::vector<PolyStep> steps(count);
  for (std::size_t step = 0; step < count; ++step)
  {
    for (int part = 0; part < 3; ++part)
    {
      steps[step].push_back(partOf(polygons(step, part), strips(step, part),
        static_cast<float>(10 * step) + static_cast<float>(part)));
    }
  }
  return steps;
}

} // namespace

TEST_F(VtkHdfTimeSteps, CellsStayWherePointsMove)
{
  const auto none = [](std::size_t, int) { return 0; };
  const auto some = [](std::size_t, int part) { return part + 1; };
  const auto last = [](std::size_t, int part) { return part == 2 ? 2 : 0; };
  const auto others = [](std::size_t, int part) { return part == 2 ? 0 : 1; };
  this->expectSteps(stepsOf(4, some, none), true);
  this->expectSteps(stepsOf(4, some, some), true);
  this->expectSteps(stepsOf(4, last, others), true);
  this->expectSteps(stepsOf(4, others, last), true);
}

/** As simulations store meshes that do not change, or whose points alone move. */
TEST_F(VtkHdfTimeSteps, GridsStoreOnceWhatStays)
{
  for (const Stays& stays :
    { Stays{ true, true }, Stays{ true, false }, Stays{ false, true }, Stays{ false, false } })
  {
    SCOPED_TRACE(std::string(stays.points ? "points " : "") + (stays.counts ? "counts" : ""));
    writeGrid(this->Folder / "grid.vtkhdf", stays);
    for (std::int64_t step = 0; step < GridSteps; ++step)
    {
      const ReadMesh mesh = this->readStep("grid.vtkhdf", step, {});
      EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 4, 7, 8 }));
      ASSERT_EQ(mesh.vertices(), 9);
      ASSERT_EQ(mesh.vertexColumns.size(), 1U);
      for (std::int64_t vertex = 0; vertex < mesh.vertices(); ++vertex)
      {
        EXPECT_EQ(mesh.positions[static_cast<std::size_t>(3 * vertex + 2)],
          stays.points ? 0.0 : static_cast<double>(step));
        EXPECT_EQ(mesh.vertexColumns[0].value(static_cast<std::size_t>(vertex)), step);
      }
      EXPECT_EQ(
        this->readStep("grid.vtkhdf", step, 1).corners, (Numbers{ 0, 1, 2, 0, 2, 3, 0, 3, 4 }));
    }
  }
}

TEST_F(VtkHdfTimeSteps, CellsChange)
{
  const auto some = [](std::size_t step, int part)
  { return part + 1 + static_cast<int>(step % 3); };
  const auto now = [](std::size_t step, int part)
  { return part == static_cast<int>(step % 3) ? 2 : 0; };
  this->expectSteps(stepsOf(5, some, now), false);
  this->expectSteps(stepsOf(
                      5, [](std::size_t, int) { return 2; }, now),
    false);
}

TEST_F(VtkHdfTimeSteps, HaveTimes)
{
  const auto some = [](std::size_t, int) { return 1; };
  const std::vector<PolyStep> steps = stepsOf(3, some, some);
  const std::filesystem::path path = this->Folder / "steps.vtkhdf";
  const auto timesWith = [&](bool hasSteps, const std::vector<double>& times)
  {
    PolyFile(path, steps, true, hasSteps, times);
    return timesOf(path);
  };
  EXPECT_EQ(timesWith(true, { -1.5, 0.25, 4.0 }), (std::vector<double>{ -1.5, 0.25, 4.0 }));
  // Without times, the numbers of the steps.
  EXPECT_EQ(timesWith(true, {}), (std::vector<double>{ 0.0, 1.0, 2.0 }));
  EXPECT_TRUE(timesWith(false, {}).empty());
  EXPECT_TRUE(timesOf(this->Folder / "absent.vtkhdf").empty());
  constexpr double NoNumber = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& wrong : std::vector<std::vector<double>>{
         { 0.0, 1.0 }, { 0.0, 0.0, 1.0 }, { 2.0, 1.0, 3.0 }, { 0.0, NoNumber, 2.0 } })
  {
    testing::expectError([&] { timesWith(true, wrong); }, "should have 3 times, each later");
  }
}

} // namespace smg::testing
