// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshCondition.h"

#include "Filters/vtkStreamingPoisson.h"
#include "IO/Container/VsmReader.h"
#include "IO/Output/SolvedMesh.h"
#include "IO/Problem/ProblemFile.h"
#include "IO/vtkStreamingMeshReader.h"
#include "Solver/Description/DescribedProblem.h"
#include "Testing/Filters/vtkHandleTesting.h"
#include "Testing/IO/vtkPieceTesting.h"
#include "Testing/Support/DescribedMesh.h"
#include "Testing/Support/TemporaryFolder.h"

#include "vtkBox.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkPlane.h"
#include "vtkSphere.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>

namespace smg::testing
{
namespace
{

/** Values of an array of the points that are no ghosts, and of the cells, piece after piece. */
struct Results
{
  std::vector<double> solution, gradient, flux;
  bool operator==(const Results&) const = default;
};

void append(vtkDataArray* array, vtkIdType tuple, std::vector<double>& values)
{
  for (int k = 0; k < array->GetNumberOfComponents(); ++k)
  {
    values.push_back(array->GetComponent(tuple, k));
  }
}

/** A mesh of tetrahedra with columns of every kind, in pieces. */
class VtkMeshCondition : public ::testing::Test
{
protected:
  VtkMeshCondition()
  {
    StreamMesh mesh = describedMesh();
    std::vector<std::uint8_t> outside; // of the sphere of radius 1.5
    for (auto p = mesh.positions.begin(); p != mesh.positions.end(); p += 3)
    {
      outside.push_back(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] >= 2.25 ? 1 : 0);
    }
    mesh.vertexColumns.push_back(makeColumn<std::uint8_t>("outside", outside));
    writeMesh(this->Folder / "mesh.vsm", mesh);
    this->Reader->SetFileName((this->Folder / "mesh.vsm").c_str());
    this->Poisson->SetInputConnection(this->Reader->GetOutputPort());
    this->Poisson->SetNumberOfPieces(4);
    this->Poisson->SetTolerance(Tolerance);
    this->Poisson->SetGradient(true);
    this->Poisson->SetFlux(true);
  }

  /** What the command line makes of a problem. */
  Results solve(const std::string& json)
  {
    VsmReader mesh(this->Folder / "mesh.vsm");
    DescribedProblem problem(readProblemText(json, "problem"), mesh.info());
    const auto source = [&] { return mesh.source(problem.vertexColumns(), problem.cellColumns()); };
    problem.prepare(*source());
    SolveOptions options;
    options.tolerance = Tolerance;
    const auto solution = smg::solve(*source(), problem, options);
    SolvedMesh solved(mesh, problem, *solution, { .gradient = true, .flux = true });
    StreamMesh all = collect(solved);
    this->Report = solution->report();
    solved.finish(this->Report);
    const auto numbers = [](const Column& column)
    {
      const auto values = column.as<double>();
      return std::vector<double>(values.begin(), values.end());
    };
    return { numbers(all.vertexColumns.back()), numbers(all.cellColumns.end()[-2]),
      numbers(all.cellColumns.back()) };
  }

  /** What the filter makes of its problem, in so many pieces. */
  Results filter(int pieces = 3)
  {
    Results results;
    for (int piece = 0; piece < pieces; ++piece)
    {
      EXPECT_EQ(updatePiece(this->Poisson, piece, pieces), 1);
      auto* output = vtkPointSet::SafeDownCast(this->Poisson->GetOutputDataObject(0));
      auto* solution = output->GetPointData()->GetArray("Solution");
      auto* gradient = output->GetCellData()->GetArray("Gradient");
      auto* flux = output->GetCellData()->GetArray("Flux");
      if (!solution || !gradient || !flux)
      {
        ADD_FAILURE() << "a result is missing";
        return {};
      }
      for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
      {
        if ((output->GetPointGhostArray()->GetValue(i) & vtkDataSetAttributes::DUPLICATEPOINT) == 0)
        {
          append(solution, i, results.solution);
        }
      }
      for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
      {
        append(gradient, c, results.gradient);
        append(flux, c, results.flux);
      }
    }
    return results;
  }

  vtkMeshCondition& add(int condition, std::vector<double> values)
  {
    auto added = vtkSmartPointer<vtkMeshCondition>::New();
    added->SetInputConnection(
      this->Chain.empty() ? this->Reader->GetOutputPort() : this->Chain.back()->GetOutputPort());
    added->SetCondition(condition);
    added->SetValue(values[0]);
    for (const double value : values.size() > 1 ? values : std::vector<double>())
    {
      added->AddValue(value);
    }
    this->Chain.push_back(added);
    this->Poisson->SetInputConnection(added->GetOutputPort());
    return *added;
  }

  void choose(int index, int association, const char* name)
  {
    this->Poisson->SetInputArrayToProcess(index, 0, 0, association, name);
  }

  static constexpr double Tolerance = 1e-9;
  TemporaryFolder Folder;
  smg::Report Report;
  vtkNew<vtkStreamingMeshReader> Reader;
  std::vector<vtkSmartPointer<vtkMeshCondition>> Chain;
  vtkNew<vtkStreamingPoisson> Poisson;
};

} // namespace

TEST_F(VtkMeshCondition, AProblemTextAndFileSayToTheFilterWhatTheySayToTheCommandLine)
{
  const Results expected = this->solve(EveryDatumOfDescribedMesh);
  this->Poisson->SetProblem(EveryDatumOfDescribedMesh);
  EXPECT_TRUE(this->filter() == expected);
  const auto report = nlohmann::json::parse(this->Poisson->GetReport());
  ASSERT_EQ(report["conditions"].size(), this->Report.conditions.size());
  for (std::size_t k = 0; k < this->Report.conditions.size(); ++k)
  {
    EXPECT_EQ(report["conditions"][k]["name"], this->Report.conditions[k].name);
    EXPECT_EQ(report["conditions"][k]["flux"], this->Report.conditions[k].flux);
  }
  EXPECT_EQ(report["energy"], this->Report.energy);
  EXPECT_EQ(report["mean"], this->Report.mean);

  std::ofstream(this->Folder / "problem.json") << EveryDatumOfDescribedMesh;
  this->Poisson->SetProblem(nullptr);
  this->Poisson->SetProblemFileName((this->Folder / "problem.json").c_str());
  EXPECT_TRUE(this->filter(1) == expected);
}

TEST_F(VtkMeshCondition, ArraysSayWhatAProblemSays)
{
  const int points = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  const int cells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
  this->choose(vtkStreamingPoisson::DIRICHLET_MASK, points, "mask");
  this->choose(vtkStreamingPoisson::DIRICHLET_VALUES, points, "three");
  this->choose(vtkStreamingPoisson::SOURCE, cells, "diagonal");
  this->choose(vtkStreamingPoisson::INITIAL_GUESS, points, "three");
  this->choose(vtkStreamingPoisson::SCREENING_ARRAY, cells, "k");
  this->choose(vtkStreamingPoisson::CONDUCTIVITY_ARRAY, cells, "K");
  this->choose(vtkStreamingPoisson::FIELD_ARRAY, cells, "q");
  EXPECT_TRUE(
    this->filter() == this->solve(R"({ "columns": 3, "conductivity": "K", "screening": "k",
    "source": "diagonal", "field": "q", "initial": "three",
    "dirichlet": [ {"mask": "mask", "value": "three"} ] })"));
}

TEST_F(VtkMeshCondition, NumbersSayWhatAProblemSays)
{
  this->Poisson->SetConductivity(3.0);
  this->Poisson->SetScreening(0.25);
  this->Poisson->SetProblem(R"({"source": [2]})");
  EXPECT_TRUE(
    this->filter() == this->solve(R"({"conductivity": 3, "screening": 0.25, "source": [2]})"));
}

TEST_F(VtkMeshCondition, AChainHoldsWhatTheRegionsOfAProblemHold)
{
  vtkNew<vtkPlane> plane; // the inside is away from its normal
  plane->SetNormal(-1, 0, 0);
  plane->SetOrigin(2.5, 0, 0);
  vtkNew<vtkBox> box;
  box->SetBounds(-9, 9, -9, 9, -9, 0.5);
  vtkNew<vtkSphere> sphere;
  sphere->SetRadius(1.5);

  this->add(vtkMeshCondition::CONDUCTIVITY, { 2 }).SetRegion(vtkMeshCondition::EVERYWHERE);
  vtkMeshCondition& tagged = this->add(vtkMeshCondition::CONDUCTIVITY, { 10, 5, 1 });
  tagged.SetRegion(vtkMeshCondition::TAG);
  tagged.SetTagArray("tag");
  tagged.SetTag(3);
  this->add(vtkMeshCondition::SOURCE, { 4 }).SetRegionFunction(sphere);
  this->add(vtkMeshCondition::SCREENING, { 0.5 }).SetRegion(vtkMeshCondition::EVERYWHERE);
  this->add(vtkMeshCondition::FLUX, { -3 }).SetRegionFunction(box);
  vtkMeshCondition& robin = this->add(vtkMeshCondition::ROBIN, { 7 });
  robin.SetRegionFunction(plane);
  robin.SetCoefficient(2.5);
  vtkMeshCondition& soft = this->add(vtkMeshCondition::SOFT, { -1 });
  soft.SetRegionFunction(sphere);
  soft.SetInsideOut(true);
  soft.SetCoefficient(0.125);
  vtkMeshCondition& held = this->add(vtkMeshCondition::DIRICHLET, { 1.5 });
  held.SetRegion(vtkMeshCondition::IDS);
  held.AddId(3);
  held.AddId(17);
  vtkMeshCondition& nearest = this->add(vtkMeshCondition::DIRICHLET, { 2 });
  nearest.SetRegion(vtkMeshCondition::POINTS);
  nearest.AddPoint(3, 2, 2);

  const Results expected = this->solve(R"({
    "conductivity": [ {"value": 2}, {"tag": ["tag", 3], "value": [10, 5, 1, 0, 0, 0]} ],
    "source": [ {"sphere": [0, 0, 0, 1.5], "value": [4]} ], "screening": 0.5,
    "flux": [ {"box": [-9, -9, -9, 9, 9, 0.5], "value": [-3]} ],
    "robin": [ {"halfspace": [1, 0, 0, 2.5], "coefficient": 2.5, "ambient": [7]} ],
    "soft": [ {"mask": "outside", "weight": 0.125, "value": [-1]} ],
    "dirichlet": [ {"vertices": [3, 17], "value": [1.5]}, {"nearest": [[3, 2, 2]], "value": [2]} ] })");
  for (const int pieces : { 1, 3 })
  {
    EXPECT_TRUE(this->filter(pieces) == expected) << pieces;
  }
  EXPECT_EQ(updatePiece(&held, 0, 1), 1);
  EXPECT_EQ(held.GetNumberOfHeldPoints(), 2);
}

TEST_F(VtkMeshCondition, SaysWhatIsWrongInOneSentence)
{
  vtkMeshCondition& condition = this->add(vtkMeshCondition::DIRICHLET, { 0 });
  Errors errors(&condition);
  const auto expectError = [&](const std::string& words)
  {
    errors.clear();
    EXPECT_EQ(updatePiece(&condition, 0, 1), 0);
    EXPECT_TRUE(errors.contain(words)) << errors.text();
  };
  expectError("The region has no implicit function");
  condition.SetRegion(vtkMeshCondition::TAG);
  expectError("The condition has no tag array");
  condition.SetRegion(vtkMeshCondition::EVERYWHERE);
  condition.RemoveAllValues();
  condition.SetValue(std::nan(""));
  expectError("The value of the condition is not a finite number");
  condition.AddValue(1);
  condition.AddValue(2);
  condition.SetCondition(vtkMeshCondition::SCREENING);
  expectError("A screening has 1 number");
  condition.SetCondition(vtkMeshCondition::CONDUCTIVITY);
  expectError("A conductivity has 1 number, 3");

  condition.RemoveAllValues();
  condition.SetValue(-1);
  Errors solving(this->Poisson);
  this->Poisson->SetProblem(R"({"source": [1]})");
  EXPECT_EQ(updatePiece(this->Poisson, 0, 1), 0);
  EXPECT_TRUE(
    solving.contain("condition 1 of the input: conductivity[0].value: must be a positive"))
    << solving.text();
}

TEST_F(VtkMeshCondition, ArraysThatAreMissingOrMeanTwoThingsAreNamed)
{
  Errors errors(this->Poisson);
  this->Poisson->SetProblem(R"({"source": "heating"})");
  EXPECT_EQ(updatePiece(this->Poisson, 0, 1), 0);
  EXPECT_TRUE(errors.contain("no numeric array heating of its points or cells (it has one, three"))
    << errors.text();
  errors.clear();
  this->Poisson->SetProblem("{");
  EXPECT_EQ(updatePiece(this->Poisson, 0, 1), 0);
  EXPECT_TRUE(errors.contain("Problem, line 1")) << errors.text();
}

/** On the preview of a surface and on the surface itself, and where JSON says the same. */
TEST_F(VtkMeshCondition, HoldsOnAPreviewWhatItHoldsOnTheMesh)
{
  const StreamMesh mesh = writeVsm(this->Folder / "torus.vsm", torus(60, 30, 0.2));
  this->Reader->SetFileName((this->Folder / "torus.vsm").c_str());
  vtkNew<vtkSphere> sphere;
  sphere->SetCenter(2.5, 0, 0);
  sphere->SetRadius(1.2);
  vtkMeshCondition& condition = this->add(vtkMeshCondition::DIRICHLET, { 1 });
  condition.SetRegionFunction(sphere);
  ASSERT_EQ(updatePiece(&condition, 0, 1), 1);
  auto* whole = vtkPointSet::SafeDownCast(condition.GetOutputDataObject(0));
  std::vector<bool> isHeld;
  for (vtkIdType i = 0; i < whole->GetNumberOfPoints(); ++i)
  {
    isHeld.push_back(whole->GetPointData()->GetArray("Condition1")->GetTuple1(i) != 0.0);
    const double* p = whole->GetPoint(i);
    EXPECT_EQ(isHeld.back(), (p[0] - 2.5) * (p[0] - 2.5) + p[1] * p[1] + p[2] * p[2] <= 1.44);
  }
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(500);
  ASSERT_EQ(updatePiece(&condition, 0, 1), 1);
  auto* preview = vtkPointSet::SafeDownCast(condition.GetOutputDataObject(0));
  ASSERT_LT(preview->GetNumberOfPoints(), mesh.vertices());
  ASSERT_GT(condition.GetNumberOfHeldPoints(), 0);
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<std::size_t>(preview->GetPointData()->GetGlobalIds()->GetTuple1(i));
    EXPECT_EQ(preview->GetPointData()->GetArray("Condition1")->GetTuple1(i) != 0.0, isHeld[id]);
  }
}

/** So that a second problem can be said behind the first. */
TEST_F(VtkMeshCondition, ConditionsGoWithTheProblemThatTheySay)
{
  this->add(vtkMeshCondition::SOURCE, { 4 }).SetRegion(vtkMeshCondition::EVERYWHERE);
  vtkMeshCondition& held = this->add(vtkMeshCondition::DIRICHLET, { 1 });
  held.SetRegion(vtkMeshCondition::IDS);
  held.AddId(3);
  ASSERT_EQ(updatePiece(&held, 0, 1), 1);
  auto* before = vtkPointSet::SafeDownCast(held.GetOutputDataObject(0));
  EXPECT_TRUE(before->GetPointData()->HasArray("Condition2"));
  EXPECT_TRUE(before->GetFieldData()->HasArray("MeshConditions"));
  ASSERT_EQ(updatePiece(this->Poisson, 0, 1), 1);
  auto* after = vtkPointSet::SafeDownCast(this->Poisson->GetOutputDataObject(0));
  EXPECT_FALSE(after->GetPointData()->HasArray("Condition2"));
  EXPECT_FALSE(after->GetFieldData()->HasArray("MeshConditions"));
  EXPECT_TRUE(after->GetFieldData()->HasArray("Report"));
  EXPECT_TRUE(before->GetPointData()->HasArray("Condition2"));
}

/** A preview has no arrays of the cells, and no point in a small region. */
TEST_F(VtkMeshCondition, AProblemThatAPreviewCannotHoldIsSolvedOnTheMesh)
{
  const StreamMesh mesh = writeVsm(this->Folder / "torus.vsm", torus(60, 30, 0.2));
  this->Reader->SetFileName((this->Folder / "torus.vsm").c_str());
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(300);
  const auto solvedOn = [&](const std::string& problem)
  {
    this->Poisson->SetProblem(problem.c_str());
    EXPECT_EQ(updatePiece(this->Poisson, 0, 1), 1);
    return nlohmann::json::parse(this->Poisson->GetReport())["vertices"].get<std::int64_t>();
  };
  Errors errors(this->Poisson);
  EXPECT_LE(solvedOn(R"({"source": [1], "screening": 1})"), 300);
  EXPECT_EQ(errors.text(), "");
  EXPECT_EQ(solvedOn(R"({"source": [1], "screening": 1,
    "conductivity": [{"tag": ["OriginalCellId", 1000003], "value": 2}]})"),
    mesh.vertices());
  EXPECT_TRUE(errors.contain("but the preview does not show them: problem: conductivity[0].tag"))
    << errors.text();
  EXPECT_NE(std::string(this->Poisson->GetNotes()).find("since the preview does not do: problem: "),
    std::string::npos)
    << this->Poisson->GetNotes();

  ASSERT_EQ(updatePiece(this->Reader, 0, 1), 1);
  auto* preview = vtkPointSet::SafeDownCast(this->Reader->GetOutputDataObject(0));
  std::vector<bool> isShown(static_cast<std::size_t>(mesh.vertices()), false);
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    isShown[static_cast<std::size_t>(preview->GetPointData()->GetGlobalIds()->GetTuple1(i))] = true;
  }
  const auto hidden = std::ranges::find(isShown, false) - isShown.begin();
  const nlohmann::json at = { mesh.positions[3 * hidden], mesh.positions[3 * hidden + 1],
    mesh.positions[3 * hidden + 2], 1e-6 };
  EXPECT_EQ(
    solvedOn(R"({"screening": 1, "dirichlet": [{"sphere": )" + at.dump() + R"(, "value": [1]}]})"),
    mesh.vertices());
}

TEST_F(VtkMeshCondition, ThePreviewOfASolidHasTheTrueSolutionAndNoGradient)
{
  this->Poisson->SetProblem(R"({"source": [1], "screening": 1})");
  const Results whole = this->filter(1);
  this->Reader->SetMaximumPointsInMemory(10);
  this->Reader->SetPreviewPoints(40);
  Errors errors(this->Poisson);
  ASSERT_EQ(updatePiece(this->Poisson, 0, 1), 1);
  EXPECT_TRUE(errors.contain("the preview of a solid has none of its cells")) << errors.text();
  auto* preview = vtkPointSet::SafeDownCast(this->Poisson->GetOutputDataObject(0));
  ASSERT_LE(preview->GetNumberOfPoints(), 40);
  EXPECT_FALSE(preview->GetCellData()->HasArray("Gradient"));
  for (vtkIdType i = 0; i < preview->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<std::size_t>(preview->GetPointData()->GetGlobalIds()->GetTuple1(i));
    EXPECT_EQ(preview->GetPointData()->GetArray("Solution")->GetTuple1(i), whole.solution[id]);
  }
}

/** Results of the cells are those of the problem that was solved, whatever has happened since. */
TEST_F(VtkMeshCondition, SolutionAndFluxAreOfOneProblem)
{
  const std::filesystem::path file = this->Folder / "problem.json";
  const auto write = [&](double conductivity)
  {
    std::ofstream(file) << R"({"source": [1], "screening": 1, "conductivity": )" << conductivity
                        << "}";
  };
  write(1.0);
  this->Poisson->SetProblemFileName(file.c_str());
  const Results before = this->filter(1);
  const auto time = std::filesystem::last_write_time(file);
  write(100.0);
  std::filesystem::last_write_time(file, time + std::chrono::seconds(2));
  const Results after = this->filter(1);
  EXPECT_NE(after.solution, before.solution);
  EXPECT_TRUE(after == this->solve(R"({"source": [1], "screening": 1, "conductivity": 100})"));
}

/** As of an earlier solve, which has the name of the result. */
TEST_F(VtkMeshCondition, AnInputArrayMayHaveTheNameOfTheResult)
{
  const int points = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  this->choose(vtkStreamingPoisson::CONDUCTIVITY_ARRAY, points, "one");
  this->Poisson->SetProblem(R"({"source": [1], "screening": 1})");
  this->Poisson->SetFlux(true);
  const Results expected = this->filter(1);
  this->Poisson->SetResultArrayName("one");
  ASSERT_EQ(updatePiece(this->Poisson, 0, 1), 1);
  auto* output = vtkPointSet::SafeDownCast(this->Poisson->GetOutputDataObject(0));
  std::vector<double> flux;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    append(output->GetCellData()->GetArray("Flux"), c, flux);
  }
  EXPECT_EQ(flux, expected.flux);

  Errors errors(this->Poisson);
  this->Poisson->SetResultArrayName("GlobalIds");
  EXPECT_EQ(updatePiece(this->Poisson, 0, 1), 0);
  EXPECT_TRUE(errors.contain("GlobalIds is that of an array that every piece has"))
    << errors.text();
  this->Poisson->SetResultArrayName("");
  EXPECT_EQ(updatePiece(this->Poisson, 0, 1), 1);
  EXPECT_TRUE(output->GetPointData()->HasArray("Solution"));
}

/** Arrays that are there already are neither overwritten nor taken away. */
TEST_F(VtkMeshCondition, LeavesArraysOfTheUserAlone)
{
  StreamMesh mesh = describedMesh();
  mesh.vertexColumns[0].spec.name = "Condition1";
  mesh.cellColumns[0].spec.name = "Condition2";
  writeMesh(this->Folder / "own.vsm", mesh);
  this->Reader->SetFileName((this->Folder / "own.vsm").c_str());
  vtkMeshCondition& condition = this->add(vtkMeshCondition::DIRICHLET, { 1 });
  condition.SetRegion(vtkMeshCondition::IDS);
  condition.AddId(3);
  ASSERT_EQ(updatePiece(&condition, 0, 1), 1);
  auto* held = vtkPointSet::SafeDownCast(condition.GetOutputDataObject(0));
  EXPECT_TRUE(held->GetPointData()->HasArray("Condition3"));
  ASSERT_EQ(updatePiece(this->Poisson, 0, 1), 1);
  auto* output = vtkPointSet::SafeDownCast(this->Poisson->GetOutputDataObject(0));
  EXPECT_TRUE(output->GetPointData()->HasArray("Condition1"));
  EXPECT_FALSE(output->GetPointData()->HasArray("Condition3"));

  condition.SetRegion(vtkMeshCondition::TAG);
  condition.SetTagArray("both");
  mesh.cellColumns[1].spec.name = mesh.vertexColumns[0].spec.name = "both";
  writeMesh(this->Folder / "both.vsm", mesh);
  this->Reader->SetFileName((this->Folder / "both.vsm").c_str());
  Errors errors(&condition);
  EXPECT_EQ(updatePiece(&condition, 0, 1), 0);
  EXPECT_TRUE(errors.contain("both have an array both")) << errors.text();
}

/** Nothing is asked of the filter then, and its last answer is to another question. */
TEST_F(VtkMeshCondition, HasNotConvergedIfAConditionFails)
{
  vtkNew<vtkPlane> plane;
  plane->SetNormal(-1, 0, 0);
  plane->SetOrigin(2.5, 0, 0);
  vtkMeshCondition& held = this->add(vtkMeshCondition::DIRICHLET, { 1 });
  held.SetRegionFunction(plane);
  ASSERT_EQ(updatePiece(this->Poisson, 0, 1), 1);
  EXPECT_EQ(this->Poisson->GetConverged(), 1);
  ASSERT_EQ(updatePiece(this->Poisson, 0, 1), 1);
  EXPECT_EQ(this->Poisson->GetConverged(), 1);
  Errors errors(&held);
  plane->SetNormal(0, 0, 0);
  EXPECT_EQ(updatePiece(this->Poisson, 0, 1), 0);
  EXPECT_TRUE(errors.contain("The plane of the region has no direction")) << errors.text();
  EXPECT_EQ(this->Poisson->GetConverged(), 0);
  plane->SetNormal(-1, 0, 0);
  ASSERT_EQ(updatePiece(this->Poisson, 0, 1), 1);
  EXPECT_EQ(this->Poisson->GetConverged(), 1);
  Errors solving(this->Poisson);
  this->Poisson->SetScreening(-1.0);
  EXPECT_EQ(updatePiece(this->Poisson, 0, 1), 0);
  EXPECT_TRUE(solving.contain("screening: must be finite and not negative")) << solving.text();
  EXPECT_EQ(this->Poisson->GetConverged(), 0);
}

TEST_F(VtkMeshCondition, TheReportOfAPreviewNamesVerticesOfTheFile)
{
  writeVsm(this->Folder / "torus.vsm", torus(60, 30, 0.2));
  this->Reader->SetFileName((this->Folder / "torus.vsm").c_str());
  this->Reader->SetMaximumPointsInMemory(100);
  this->Reader->SetPreviewPoints(300);
  this->Poisson->SetProblem(
    R"({"screening": 1, "source": [{"sphere": [3, 0, 0, 1.5], "value": 1}]})");
  ASSERT_EQ(updatePiece(this->Poisson, 0, 1), 1);
  const auto report = nlohmann::json::parse(this->Poisson->GetReport());
  const auto& maximum = report["maximum"][0];
  auto* output = vtkPointSet::SafeDownCast(this->Poisson->GetOutputDataObject(0));
  auto* ids = output->GetPointData()->GetArray("OriginalId");
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const bool isLargest =
      output->GetPointData()->GetArray("Solution")->GetTuple1(i) == maximum["value"].get<double>();
    EXPECT_EQ(isLargest, ids->GetTuple1(i) == maximum["vertex"].get<double>()) << i;
  }
}

} // namespace smg::testing
