// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Filters/MeshConditionFixture.h"

#include "vtkBox.h"
#include "vtkPlane.h"
#include "vtkSphere.h"
#include "vtkTransform.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace smg::testing
{

TEST_F(VtkMeshCondition, AProblemTextAndFileSayToTheFilterWhatTheySayToTheCommandLine)
{
  const Results expected = this->solve(EveryDatumOfDescribedMesh);
  this->Poisson->SetProblem(EveryDatumOfDescribedMesh);
  EXPECT_TRUE(this->filter() == expected);
  const std::string report = this->Poisson->GetReport();
  for (const char* place : { "/conditions", "/energy", "/mean", "/minimum", "/maximum" })
  {
    EXPECT_EQ(jsonAt(report, place), jsonAt(this->Report.json(), place));
  }

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
  vtkNew<vtkPlane> plane; // its inside is opposite to its normal
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
  expectError("The region has no tag array");
  condition.SetRegion(vtkMeshCondition::EVERYWHERE);
  condition.RemoveAllValues();
  condition.SetValue(std::nan(""));
  expectError("Value is nan: set it to a finite number.");
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
  EXPECT_TRUE(solving.contain("Mesh Condition 1 (Conductivity): Value: must be a positive"))
    << solving.text();
  // Where the solver counts the entries of all conditions of one kind, too.
  condition.SetCondition(vtkMeshCondition::DIRICHLET);
  vtkMeshCondition& second = this->add(vtkMeshCondition::DIRICHLET, { 1, 2 });
  second.SetRegion(vtkMeshCondition::EVERYWHERE);
  this->Poisson->SetProblem(nullptr);
  solving.clear();
  EXPECT_EQ(updatePiece(this->Poisson, 0, 1), 0);
  EXPECT_TRUE(solving.contain("Mesh Condition 1 (Dirichlet): Value: the number of numbers is 1"))
    << solving.text();
  EXPECT_EQ(solving.text().find("dirichlet["), std::string::npos) << solving.text();
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
  EXPECT_TRUE(errors.contain("Problem: this is not valid JSON: parse error at line 1"))
    << errors.text();
}

/** So that a second problem can follow the first. */
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

/** Results of the cells are those of the problem that was solved, regardless of later changes. */
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

/** For example of an earlier solve, which has the name of the result. */
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

/** Existing arrays are neither overwritten nor removed. */
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
  // As in JSON, the tag of a Dirichlet condition is then that of the points.
  const double tag = mesh.vertexColumns[0].value(3);
  condition.SetTag(tag);
  const Results byCondition = this->filter(1);
  this->Poisson->SetInputConnection(this->Reader->GetOutputPort());
  std::ostringstream problem;
  problem.precision(17);
  problem << R"({"dirichlet": [{"tag": ["both", )" << tag << R"(], "value": 1}]})";
  this->Poisson->SetProblem(problem.str().c_str());
  EXPECT_EQ(this->filter(1).solution, byCondition.solution);
}

/** As ParaView fits one to a flat mesh: its transform has no inverse. */
TEST_F(VtkMeshCondition, AFlatBoxIsRefused)
{
  vtkNew<vtkTransform> transform;
  vtkNew<vtkBox> box;
  box->SetBounds(0, 1, 0, 1, 0, 1);
  box->SetTransform(transform);
  vtkMeshCondition& held = this->add(vtkMeshCondition::DIRICHLET, { 1 });
  held.SetRegionFunction(box);
  for (const double length : { 0.0, 100.0 })
  {
    transform->Identity();
    transform->Scale(100.0, 100.0, length);
    transform->Inverse();
    Errors errors(&held);
    held.Modified();
    updatePiece(&held, 0, 1);
    EXPECT_EQ(errors.contain("The box of the region is flat"), length == 0.0) << errors.text();
  }
}

/** The filter is not executed then, and its last outcome belongs to another problem. */
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
  const auto begins = [](const char* text, const char* beginning)
  { return std::string(text).starts_with(beginning); };
  const char* error = "The plane of the region has no direction";
  EXPECT_TRUE(begins(this->Poisson->GetOutcome(), "Not solved: The input has failed"))
    << this->Poisson->GetOutcome();
  EXPECT_TRUE(begins(held.GetOutcome(), (std::string("Failed: ") + error).c_str()))
    << held.GetOutcome();
  plane->SetNormal(-1, 0, 0);
  ASSERT_EQ(updatePiece(this->Poisson, 0, 1), 1);
  EXPECT_EQ(this->Poisson->GetConverged(), 1);
  Errors solving(this->Poisson);
  this->Poisson->SetScreening(-1.0);
  EXPECT_EQ(updatePiece(this->Poisson, 0, 1), 0);
  EXPECT_TRUE(solving.contain("Screening is -1: set it to at least 0.")) << solving.text();
  EXPECT_EQ(this->Poisson->GetConverged(), 0);
}

} // namespace smg::testing
