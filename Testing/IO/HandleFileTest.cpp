// SPDX-License-Identifier: BSD-3-Clause
#include "smg/DescribedHandles.h"
#include "smg/DescriptionFiles.h"

#include "Testing/IO/RegionFileFixture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace smg::testing
{
namespace
{

const std::string Fixed = R"({"region": {"sphere": [0, 0, 0, 9]}, "fixed": true})";

class HandleFileText : public RegionFile
{
protected:
  /** The handles of a file, prepared on the mesh. */
  std::unique_ptr<DescribedHandles> parse(const std::string& json)
  {
    const auto file = this->file(json);
    auto handles =
      std::make_unique<DescribedHandles>(readHandleFile(file), this->Source.info(), file.string());
    this->Source.rewind(BlockCells);
    handles->prepare(this->Source);
    return handles;
  }

  /** The error of the text, when it is read or when it is prepared on the mesh. */
  std::string errorOf(const std::string& json)
  {
    const std::string message = messageOf([&] { this->parse(json); });
    return message.empty() ? "no error" : message;
  }
  /** The error of a file with a valid handle and this one. */
  std::string errorOfHandle(const std::string& handle)
  {
    return this->errorOf(R"({"handles": [)" + Fixed + ", " + handle + "]}");
  }

  /** The values of the handles at all vertices. */
  VertexHandles ask(DescribedHandles& handles)
  {
    VertexHandles all;
    this->Source.rewind(BlockCells);
    for (MeshBlock block; this->Source.next(block);)
    {
      VertexHandles some;
      some.clear(static_cast<std::size_t>(block.vertices()));
      handles.at(block, some);
      all.mask.insert(all.mask.end(), some.mask.begin(), some.mask.end());
      all.target.insert(all.target.end(), some.target.begin(), some.target.end());
      all.rotation.insert(all.rotation.end(), some.rotation.begin(), some.rotation.end());
      all.logScale.insert(all.logScale.end(), some.logScale.begin(), some.logScale.end());
    }
    return all;
  }
  VertexHandles ask(const std::string& json) { return this->ask(*this->parse(json)); }

  double position(std::size_t vertex, std::size_t axis) const
  {
    return this->Source.mesh().positions[3 * vertex + axis];
  }
};

} // namespace

TEST_F(HandleFileText, LaterHandlesWinAndAllAreCounted)
{
  const VertexHandles handles = this->ask(R"({"handles": [
    {"region": {"halfspace": [1, 0, 0, 2]}, "fixed": true},
    {"region": {"box": [2, 0, -1, 2.6, 9, 1]}, "translate": [0, 0, 1.5]},
    {"region": {"vertices": [1003, 1003]},
     "translate": [0, 0, 7], "scale": 2, "rotate": {"axis": [0, 0, 3], "degrees": 200},
     "center": [1, 0, 0]}]})");
  const double c = std::cos(200 * std::numbers::pi / 180);
  const double s = std::sin(200 * std::numbers::pi / 180);
  for (std::size_t i = 0; i < 25; ++i)
  {
    const double x = this->position(i, 0);
    const double y = this->position(i, 1);
    const bool first = x >= 2;
    const bool second = first && x <= 2.6;
    const bool third = i == 21;
    ASSERT_EQ(int(handles.mask[i]), first + second + third);
    if (third)
    {
      EXPECT_NEAR(handles.target[3 * i], 1 + 2 * (c * (x - 1) - s * y), 1e-14);
      EXPECT_NEAR(handles.target[3 * i + 1], 2 * (s * (x - 1) + c * y), 1e-14);
      EXPECT_EQ(handles.target[3 * i + 2], 7.0);
      EXPECT_NEAR(handles.rotation[3 * i + 2], 200 * std::numbers::pi / 180, 1e-15);
      EXPECT_DOUBLE_EQ(handles.logScale[i], std::log(2.0));
    }
    else if (first)
    {
      EXPECT_EQ(handles.target[3 * i], x);
      EXPECT_EQ(handles.target[3 * i + 1], y);
      EXPECT_EQ(handles.target[3 * i + 2], second ? 1.5 : 0.0);
      EXPECT_EQ(handles.rotation[3 * i + 2], 0.0);
      EXPECT_EQ(handles.logScale[i], 0.0);
    }
  }
}

TEST_F(HandleFileText, FixedAfterAMotionIsFixed)
{
  const VertexHandles handles = this->ask(R"({"handles": [
    {"region": {"sphere": [0, 0, 0, 9]}, "rotate": {"axis": [1, 0, 0], "degrees": 90}, "scale": 3},
    )" + Fixed + "]}");
  EXPECT_EQ(handles.target, this->Source.mesh().positions);
  EXPECT_EQ(handles.rotation, std::vector<double>(75, 0.0));
  EXPECT_EQ(handles.logScale, std::vector<double>(25, 0.0));
  EXPECT_EQ(handles.mask, std::vector<std::uint8_t>(25, 2));
}

TEST_F(HandleFileText, TheCountOfHandlesSaturates)
{
  std::string json = R"({"handles": [)";
  for (int i = 0; i < 300; ++i)
  {
    json += Fixed + (i < 299 ? "," : "]}");
  }
  EXPECT_EQ(this->ask(json).mask, std::vector<std::uint8_t>(25, 255));
}

TEST_F(HandleFileText, SpheresAndBoxesTurnAboutTheirMiddle)
{
  for (const char* region : { R"({"sphere": [1, 2, 0, 9]})", R"({"box": [-6, -5, -1, 8, 9, 1]})" })
  {
    const VertexHandles grown =
      this->ask(R"({"handles": [{"region": )" + std::string(region) + R"(, "scale": 2}]})");
    const VertexHandles said = this->ask(R"({"handles": [{"region": )" + std::string(region) +
                                         R"(, "scale": 2, "center": [1, 2, 0]}]})");
    EXPECT_EQ(grown.target, said.target);
    EXPECT_EQ(grown.target[0], 2 * this->position(0, 0) - 1);
  }
  const std::string turned = this->errorOfHandle(
    R"({"region": {"halfspace": [1, 0, 0, 0]}, "rotate": {"axis": [0, 0, 1], "degrees": 3}})");
  EXPECT_CONTAINS(turned, "handles[1]: turns or grows about no point");
  EXPECT_CONTAINS(
    this->errorOfHandle(R"({"region": {"vertices": [1000]}, "scale": 1})"), "add \"center\"");
}

TEST_F(HandleFileText, SetsWhatTheFileSaysAndNoMore)
{
  DeformOptions options;
  options.weights = Weights::Uniform;
  options.cycles = 4;
  options.tolerance = 0.25;
  const auto apply = [&](const std::string& members) {
    readHandleFile(this->file(R"({"handles": [)" + Fixed + "]" + members + "}")).applyTo(options);
  };
  apply("");
  EXPECT_EQ(options.weights, Weights::Uniform);
  EXPECT_EQ(options.cycles, 4);
  EXPECT_EQ(options.tolerance, 0.25);
  apply(R"(, "weights": "clamped", "cycles": 7)");
  EXPECT_EQ(options.weights, Weights::Clamped);
  EXPECT_EQ(options.cycles, 7);
  apply(R"(, "weights": "cotangent")");
  EXPECT_EQ(options.weights, Weights::Cotangent);
  apply(R"(, "tolerance": 1e-3, "weights": "uniform")");
  EXPECT_EQ(options.weights, Weights::Uniform);
  EXPECT_EQ(options.cycles, 0);
  EXPECT_EQ(options.tolerance, 1e-3);
}

TEST_F(HandleFileText, ErrorsNameThePlace)
{
  EXPECT_CONTAINS(this->errorOf("[]"), "p.json: must be an object");
  EXPECT_CONTAINS(this->errorOf("{}"), "p.json: has no 'handles'");
  EXPECT_CONTAINS(this->errorOf(R"({"handles": {}})"), "handles: must be an array");
  EXPECT_CONTAINS(this->errorOf(R"({"handles": []})"), "handles: must have at least one");
  EXPECT_CONTAINS(this->errorOf(R"({"handle": []})"), "handle: is not known");
  EXPECT_CONTAINS(this->errorOf("{\"handles\":\n[NaN]}"),
    "p.json: this is not valid JSON: parse error at line 2, column 2");
  EXPECT_CONTAINS(this->errorOf(R"({"handles": [1e999]})"), "number overflow parsing '1e999'");
  const auto withHandle = [this](const std::string& members)
  { return this->errorOf(R"({"handles": [)" + Fixed + "], " + members + "}"); };
  EXPECT_EQ(withHandle(R"("cycles": 3)"), "no error");
  EXPECT_CONTAINS(withHandle(R"("weights": "heat")"), "weights: must be");
  EXPECT_CONTAINS(withHandle(R"("cycles": 0)"), "cycles: must be an integer from 1");
  EXPECT_CONTAINS(withHandle(R"("cycles": 2.5)"), "cycles: must be an integer from 1");
  EXPECT_CONTAINS(withHandle(R"("tolerance": 1)"), "tolerance: must be between 0 and 1");
  EXPECT_CONTAINS(withHandle(R"("tolerance": "small")"), "tolerance: must be a finite number");
  EXPECT_CONTAINS(withHandle(R"("tolerance": 0.5, "cycles": 2)"), "does not go with cycles");
}

TEST_F(HandleFileText, IsReadWithoutAMesh)
{
  const DeformationDescription data =
    readHandleFile(this->file(R"({"handles": [)" + Fixed + R"(, {"region": {"vertices": [7, 3, 7]},
    "translate": [1, 0, 0]}], "cycles": 3})"));
  ASSERT_EQ(data.handles.size(), 2u);
  const auto& region = std::get<Region>(data.handles[1].where);
  ASSERT_TRUE(region.vertices());
  EXPECT_EQ(region.vertices()->ids, (std::vector<std::int64_t>{ 3, 7 }));
  EXPECT_EQ(data.cycles, 3);
  expectError([&] { readHandleFile(this->file("{}")); }, "p.json: has no 'handles'");
  expectError([&] { readHandleFile(this->Folder.path()); }, "this is a folder");
}

TEST_F(HandleFileText, NotesSayWhatHandlesDoNotDo)
{
  const auto notesOn = [this](const std::string& handles)
  {
    const std::unique_ptr<DescribedHandles> described =
      this->parse(R"({"handles": [)" + handles + "]}");
    this->ask(*described);
    return described->notes();
  };
  using Notes = std::vector<std::string>;
  const std::string right = R"({"region": {"halfspace": [1, 0, 0, 2]}, )";
  const std::string moving = right + R"("translate": [0, 0, 1]})";
  EXPECT_EQ(notesOn(Fixed + ", " + moving), Notes{});
  EXPECT_EQ(
    notesOn(right + R"("translate": [0, 0, 0]})"), Notes{ "No handle moves anything: OUT is IN." });
  EXPECT_EQ(notesOn(moving + ", " + Fixed),
    (Notes{ "handles[0] holds nothing that a later handle does not hold.",
      "No handle moves anything: OUT is IN." }));
  EXPECT_EQ(notesOn(Fixed + ", " + right + R"("fixed": true}, )" + moving),
    Notes{ "handles[1] holds nothing that a later handle does not hold." });
}

TEST_F(HandleFileText, HandlesStandInColumnsToo)
{
  StreamMesh mesh = lattice();
  std::vector<double> targets;
  std::vector<std::uint8_t> mask;
  for (int i = 0; i < 25; ++i)
  {
    mask.push_back(i % 5 == 0 ? 2 : 0);
    targets.insert(targets.end(), { 1.0 * i, 2.0, 3.0 });
  }
  mesh.vertexColumns.push_back(makeColumn<std::uint8_t>("held", mask));
  mesh.vertexColumns.push_back(makeColumn<double>("goal", targets, 3));
  this->Source = MemorySource(mesh, BlockCells);
  const std::string middle =
    std::to_string(this->position(12, 0)) + ", " + std::to_string(this->position(12, 1));
  const VertexHandles handles = this->ask(R"({"handles": [
    {"region": {"mask": "held"}, "target": "goal", "rotation": [0, 0, 1], "logScale": 0.5},
    {"region": {"nearest": [[)" + middle + R"(, 0]]}, "target": "position"}]})");
  for (std::size_t i = 0; i < 25; ++i)
  {
    const bool near = i == 12;
    const bool held = i % 5 == 0;
    ASSERT_EQ(int(handles.mask[i]), (held ? 2 : 0) + (near ? 1 : 0));
    EXPECT_EQ(handles.target[3 * i], near   ? this->position(12, 0)
                                     : held ? 1.0 * static_cast<double>(i)
                                            : 0.0);
    EXPECT_EQ(handles.rotation[3 * i + 2], held && !near ? 1.0 : 0.0);
    EXPECT_EQ(handles.logScale[i], held && !near ? 0.5 : 0.0);
  }
  const VertexHandles border =
    this->ask(R"({"handles": [{"region": {"boundary": true}, "fixed": true}]})");
  EXPECT_EQ(std::ranges::count(border.mask, 1), 16);
  EXPECT_CONTAINS(this->errorOfHandle(R"({"region": {"mask": "hold"}, "fixed": true})"),
    "handles[1].region.mask: the mesh has no column 'hold'");
  EXPECT_CONTAINS(this->errorOfHandle(R"({"region": {"mask": "held"}, "target": "held"})"),
    "handles[1].target: the components of the column 'held' are 1, but must have 3");
  EXPECT_CONTAINS(this->errorOfHandle(R"({"region": {"mask": "held"}, "logScale": 1})"),
    "handles[1]: has no 'target'");
  EXPECT_CONTAINS(
    this->errorOfHandle(R"({"region": {"mask": "held"}, "target": "goal", "scale": 2})"),
    "handles[1]: goes by its target");
}

TEST_F(HandleFileText, NearestVerticesHaveTargetsOfTheirOwn)
{
  const auto point = [this](std::int64_t v)
  {
    return "[" + std::to_string(this->position(v, 0)) + ", " +
           std::to_string(this->position(v, 1)) + ", 0.125]";
  };
  const std::string near =
    R"({"region": {"nearest": [)" + point(17) + ", " + point(3) + ", " + point(17) + "]}, ";
  const VertexHandles handles =
    this->ask(R"({"handles": [)" + near +
              R"("target": [[9, 9, 9], [3, 4, 5], [6, 7, 8]], "rotation": [0, 0, 1]}]})");
  EXPECT_EQ(std::ranges::count(handles.mask, 1), 2);
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_EQ(handles.target[3 * 3 + k], 3.0 + static_cast<double>(k));
    EXPECT_EQ(handles.target[3 * 17 + k], 6.0 + static_cast<double>(k)); // the last point counts
  }
  EXPECT_EQ(handles.rotation[3 * 17 + 2], 1.0);
  EXPECT_CONTAINS(this->errorOfHandle(near + R"("target": [[1, 2, 3]]})"),
    "handles[1].target: has 1 positions, the region 3 points");
  EXPECT_CONTAINS(
    this->errorOfHandle(R"({"region": {"sphere": [0, 0, 0, 9]}, "target": [[1, 2, 3]]})"),
    "handles[1].target: has 1 positions, the region no nearest points");
  EXPECT_CONTAINS(this->errorOfHandle(near + R"("target": [[1, 2, 3], [1, 2], [0, 0, 0]]})"),
    "handles[1].target[1]: must be an array of 3 numbers");
}

TEST_F(HandleFileText, ErrorsOfHandlesNameThePlace)
{
  const auto errorWith = [this](const std::string& members)
  { return this->errorOfHandle(R"({"region": {"sphere": [0, 0, 0, 9]})" + members + "}"); };
  EXPECT_EQ(errorWith(R"(, "scale": 2)"), "no error");
  EXPECT_CONTAINS(errorWith(""), "handles[1]: must be fixed, or have");
  EXPECT_CONTAINS(errorWith(R"(, "fixed": false)"), "handles[1].fixed: can only be true");
  EXPECT_CONTAINS(errorWith(R"(, "fixed": 1)"), "handles[1].fixed: can only be true");
  EXPECT_CONTAINS(errorWith(R"(, "fixed": true, "scale": 2)"), "handles[1].fixed: goes with no");
  EXPECT_CONTAINS(errorWith(R"(, "fixed": true, "center": [0, 0, 0])"), "handles[1].center: needs");
  EXPECT_CONTAINS(errorWith(R"(, "turn": 1)"), "handles[1].turn: is not known");
  EXPECT_CONTAINS(errorWith(R"(, "translate": [0, 1])"), "handles[1].translate: must be an array");
  EXPECT_CONTAINS(errorWith(R"(, "translate": [0, null, 1])"), "handles[1].translate[1]: must be");
  EXPECT_CONTAINS(errorWith(R"(, "translate": ["NaN", 0, 1])"), "handles[1].translate[0]: must be");
  EXPECT_CONTAINS(errorWith(R"(, "scale": 0)"), "handles[1].scale: must be greater than 0");
  EXPECT_CONTAINS(errorWith(R"(, "scale": -1.5)"), "handles[1].scale: must be greater than 0");
  EXPECT_CONTAINS(errorWith(R"(, "scale": 1e-21)"), "handles[1].scale: must be");
  EXPECT_CONTAINS(errorWith(R"(, "scale": 1e21)"), "handles[1].scale: must be");
  EXPECT_CONTAINS(errorWith(R"(, "rotate": {"axis": [1, 0, 0], "degrees": 1000001})"),
    "handles[1].rotate.degrees: must be between");
  EXPECT_CONTAINS(errorWith(R"(, "scale": "x")"), "handles[1].scale: must be a finite number");
  EXPECT_CONTAINS(errorWith(R"(, "rotate": 90)"), "handles[1].rotate: must be an object");
  EXPECT_CONTAINS(errorWith(R"(, "rotate": {"degrees": 90})"), "handles[1].rotate: has no 'axis'");
  EXPECT_CONTAINS(
    errorWith(R"(, "rotate": {"axis": [1, 0, 0]})"), "handles[1].rotate: has no 'degrees'");
  EXPECT_CONTAINS(errorWith(R"(, "rotate": {"axis": [0, 0, 0], "degrees": 90})"),
    "handles[1].rotate.axis: must have a direction");
  EXPECT_CONTAINS(errorWith(R"(, "rotate": {"axis": [1, 0, 0], "radians": 1})"),
    "handles[1].rotate.radians: is not known");
  EXPECT_CONTAINS(errorWith(R"(, "center": [0, 0, 0],
      "rotate": {"axis": [1, 0, 0], "degrees": 1, "center": [0, 0, 0]})"),
    "handles[1].center: stands here and in rotate");
}

TEST_F(HandleFileText, ErrorsOfRegionsNameThePlace)
{
  const auto errorIn = [this](const std::string& region)
  { return this->errorOfHandle(R"({"fixed": true, "region": )" + region + "}"); };
  EXPECT_EQ(errorIn(R"({"vertices": [1000, 1024]})"), "no error");
  EXPECT_CONTAINS(this->errorOfHandle(R"({"fixed": true})"), "handles[1]: has no 'region'");
  EXPECT_CONTAINS(errorIn("{}"), "handles[1].region: must have exactly one of");
  EXPECT_CONTAINS(errorIn(R"({"cone": [1]})"), "handles[1].region.cone: is not known");
  EXPECT_CONTAINS(errorIn(R"({"sphere": [0, 0, 0, -1]})"), "handles[1].region.sphere: must have");
  EXPECT_CONTAINS(
    errorIn(R"({"halfspace": [0, 0, 0, 1]})"), "handles[1].region.halfspace: must have");
  EXPECT_CONTAINS(errorIn(R"({"vertices": [1000, -1]})"), "handles[1].region.vertices[1]: must be");
  EXPECT_CONTAINS(errorIn(R"({"vertices": [1e3]})"), "handles[1].region.vertices[0]: must be");
  EXPECT_CONTAINS(errorIn(R"({"vertices": 1000})"), "handles[1].region.vertices: must be an array");
  EXPECT_CONTAINS(errorIn(R"({"vertices": []})"), "must name at least one");
  EXPECT_CONTAINS(errorIn(R"({"sphere": [0, 0, 50, 1]})"), "handles[1].region: no vertex");
  EXPECT_CONTAINS(
    errorIn(R"({"vertices": [1000, 1025]})"), "handles[1].region.vertices: the mesh has no vertex");
}

} // namespace smg::testing
