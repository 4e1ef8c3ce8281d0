// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshCondition.h"
#include "Filters/vtkMeshRegion.h"
#include "Filters/vtkStreamingBlend.h"
#include "Filters/vtkStreamingDistance.h"
#include "Filters/vtkStreamingMeshDeformation.h"
#include "Filters/vtkStreamingMeshPreview.h"
#include "Filters/vtkStreamingMeshSimplification.h"
#include "Filters/vtkStreamingMeshSmoothing.h"
#include "Filters/vtkStreamingPoisson.h"
#include "IO/Vtk/vtkStreamingMeshConverter.h"
#include "IO/Vtk/vtkStreamingMeshWriter.h"
#include "Solver/Core/Text.h"
#include "Testing/Filters/MeshHandleFixture.h"

#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// A number out of its range is an error of the update, which names it; no other one is taken. Of
// the options of jobs, whose ranges are those of their tables, there is one of each kind.

namespace smg::testing
{
namespace
{

constexpr vtkIdType NoLimit = std::numeric_limits<vtkIdType>::max();

/** One property of an algorithm. */
template <class Algorithm, class Number>
struct Property
{
  const char* name;
  void (Algorithm::*set)(Number);
  Number (Algorithm::*get)();
  vtkIdType least, most = NoLimit;
};

/** Expects that a number out of the range is refused by its name, before the update does anything,
 * and that it does not fail with the former number. */
template <class Algorithm, class Number>
void expectRange(Algorithm* algorithm, const Property<Algorithm, Number>& property)
{
  const Number before = (algorithm->*property.get)();
  std::vector<vtkIdType> refused{ property.least - 1, property.least - 1000 };
  std::string range = "at least " + std::to_string(property.least);
  if (property.most != NoLimit)
  {
    refused.push_back(property.most + 1);
    range =
      "a number from " + std::to_string(property.least) + " to " + groupedDigits(property.most);
  }
  const auto isUpdated = [&]
  {
    auto* writer = vtkStreamingMeshWriter::SafeDownCast(algorithm);
    return writer ? writer->Write() == 1 : updatePiece(algorithm, 0, 1) == 1;
  };
  for (const vtkIdType number : refused)
  {
    (algorithm->*property.set)(static_cast<Number>(number));
    EXPECT_EQ((algorithm->*property.get)(), static_cast<Number>(number)) << property.name;
    Errors said(algorithm);
    EXPECT_FALSE(isUpdated()) << property.name << " " << number;
    EXPECT_TRUE(said.contain(
      std::string(property.name) + " is " + std::to_string(number) + ": set it to " + range + "."))
      << property.name << " " << number << ": " << said.text();
    std::ostringstream printed;
    algorithm->Print(printed);
    (algorithm->*property.set)(before);
    said.clear();
    isUpdated();
    EXPECT_FALSE(said.contain(": set it to ")) << said.text();
  }
}

/** The same for a property with a fraction: each of `refused` is refused with the range in words.
 */
template <class Algorithm>
void expectRealRange(Algorithm* algorithm, const char* name, void (Algorithm::*set)(double),
  double (Algorithm::*get)(), std::vector<std::pair<double, const char*>> refused,
  const std::string& range)
{
  const double before = (algorithm->*get)();
  refused.insert(refused.end(), { { std::numeric_limits<double>::quiet_NaN(), "nan" },
                                  { std::numeric_limits<double>::infinity(), "inf" } });
  for (const auto& [number, text] : refused)
  {
    (algorithm->*set)(number);
    Errors said(algorithm);
    EXPECT_FALSE(updatePiece(algorithm, 0, 1) == 1) << name << " " << text;
    EXPECT_TRUE(said.contain(std::string(name) + " is " + text + ": set it to " + range + "."))
      << name << " " << text << ": " << said.text();
    (algorithm->*set)(before);
    said.clear();
    updatePiece(algorithm, 0, 1);
    EXPECT_FALSE(said.contain(": set it to ")) << said.text();
  }
}

constexpr int Pieces = 1000000;

/** The numbers of every solver. */
void expectRangesOfSolver(vtkStreamingSolver* solver)
{
  using S = vtkStreamingSolver;
  SCOPED_TRACE(solver->GetClassName());
  expectRange<S, int>(solver, { "Solve", &S::SetSolve, &S::GetSolve, 0, 2 });
  expectRange<S, int>(solver, { "Weights", &S::SetWeights, &S::GetWeights, 0, 2 });
  expectRange<S, int>(solver, { "Sweeps", &S::SetSweeps, &S::GetSweeps, 1, 20 });
  expectRange<S, int>(solver, { "MemoryLimit", &S::SetMemoryLimit, &S::GetMemoryLimit, 1 });
  expectRange<S, int>(solver, { "ScratchLimit", &S::SetScratchLimit, &S::GetScratchLimit, 0 });
  expectRange<S, int>(
    solver, { "NumberOfPieces", &S::SetNumberOfPieces, &S::GetNumberOfPieces, 0, Pieces });
}

/** The numbers of every region. */
void expectRangesOfRegion(vtkRegionFilter* filter)
{
  using R = vtkRegionFilter;
  SCOPED_TRACE(filter->GetClassName());
  expectRange<R, int>(filter, { "Region", &R::SetRegion, &R::GetRegion, 0, 8 });
  expectRange<R, int>(filter, { "IdType", &R::SetIdType, &R::GetIdType, 0, 1 });
  expectRange<R, int>(filter, { "Rings", &R::SetRings, &R::GetRings, 0, 100 });
  expectRange<R, int>(
    filter, { "NumberOfPieces", &R::SetNumberOfPieces, &R::GetNumberOfPieces, 0, Pieces });
}

class VtkPropertyRange : public VtkMeshHandle
{
protected:
  template <class Filter>
  void connect(Filter& filter)
  {
    filter.SetInputConnection(this->Reader->GetOutputPort());
  }
};

TEST_F(VtkPropertyRange, OfSolvers)
{
  using Poisson = vtkStreamingPoisson;
  using Smoothing = vtkStreamingMeshSmoothing;
  using Blend = vtkStreamingBlend;
  using Distance = vtkStreamingDistance;
  using Deformation = vtkStreamingMeshDeformation;
  vtkNew<Poisson> poisson;
  vtkNew<Smoothing> smoothing;
  vtkNew<Blend> blend;
  vtkNew<Distance> distance;
  vtkNew<Deformation> deformation;
  for (vtkStreamingSolver* solver :
    { static_cast<vtkStreamingSolver*>(poisson), static_cast<vtkStreamingSolver*>(smoothing),
      static_cast<vtkStreamingSolver*>(blend), static_cast<vtkStreamingSolver*>(distance),
      static_cast<vtkStreamingSolver*>(deformation) })
  {
    this->connect(*solver);
    expectRangesOfSolver(solver);
    const bool isPoisson = solver == poisson.Get();
    std::vector<std::pair<double, const char*>> tolerances{ { 1.0, "1" }, { -1e-8, "-1e-08" } };
    if (!isPoisson)
    {
      tolerances.emplace_back(0.0, "0");
    }
    expectRealRange<vtkStreamingSolver>(solver, "Tolerance", &vtkStreamingSolver::SetTolerance,
      &vtkStreamingSolver::GetTolerance, tolerances,
      std::string("a number between 0 and 1, both excluded") +
        (isPoisson ? ", or to 0 (automatic)" : ""));
  }
  expectRealRange<Poisson>(poisson, "Conductivity", &Poisson::SetConductivity,
    &Poisson::GetConductivity, { { 0.0, "0" }, { -1.0, "-1" } }, "a number greater than 0");
  expectRealRange<Poisson>(poisson, "Screening", &Poisson::SetScreening, &Poisson::GetScreening,
    { { -0.5, "-0.5" } }, "at least 0");
  expectRealRange<Smoothing>(smoothing, "Size", &Smoothing::SetSize, &Smoothing::GetSize,
    { { 0.0, "0" }, { -4.0, "-4" } }, "a number greater than 0");
  smoothing->SetKeepEdges(true);
  expectRealRange<Smoothing>(smoothing, "EdgeAngle", &Smoothing::SetEdgeAngle,
    &Smoothing::GetEdgeAngle, { { 0.0, "0" }, { 180.0, "180" } },
    "a number from 0 to 180, both excluded");
  smoothing->SetKeepEdges(false);
  expectRealRange<Blend>(
    blend, "Anchor", &Blend::SetAnchor, &Blend::GetAnchor, { { -1.0, "-1" } }, "at least 0");
  expectRange<vtkMultiEngineSolver, int>(poisson,
    { "Engine", &vtkMultiEngineSolver::SetEngine, &vtkMultiEngineSolver::GetEngine, 0, 2 });
  expectRange<Smoothing, int>(
    smoothing, { "SizeUnit", &Smoothing::SetSizeUnit, &Smoothing::GetSizeUnit, 0, 2 });
  expectRange<Smoothing, int>(
    smoothing, { "Boundary", &Smoothing::SetBoundary, &Smoothing::GetBoundary, 0, 3 });
  expectRealRange<Distance>(distance, "Within", &Distance::SetWithin, &Distance::GetWithin,
    { { -1.0, "-1" } }, "a number above 0, or to 0 (none)");
  expectRange<Deformation, vtkIdType>(
    deformation, { "InteractivePoints", &Deformation::SetInteractivePoints,
                   &Deformation::GetInteractivePoints, 0 });
  expectRange<Deformation, vtkIdType>(
    deformation, { "DragPoints", &Deformation::SetDragPoints, &Deformation::GetDragPoints, 8 });
}

TEST_F(VtkPropertyRange, OfRegions)
{
  using Handle = vtkMeshHandle;
  using Condition = vtkMeshCondition;
  vtkNew<Condition> condition;
  vtkNew<vtkMeshRegion> region;
  for (vtkRegionFilter* filter : { static_cast<vtkRegionFilter*>(this->Handle),
         static_cast<vtkRegionFilter*>(condition), static_cast<vtkRegionFilter*>(region) })
  {
    this->connect(*filter);
    filter->SetRegionFunction(this->Ball);
    expectRangesOfRegion(filter);
    using Region = vtkRegionFilter;
    filter->SetRegion(Region::POINTS);
    filter->AddPoint(1.0, 0.0, 0.0);
    expectRealRange<Region>(filter, "Radius", &Region::SetRadius, &Region::GetRadius,
      { { -2.0, "-2" }, { -1e-9, "-1e-09" } }, "at least 0, or to -1 (automatic)");
    filter->SetRegion(Region::TAG);
    expectRealRange<Region>(filter, "Tag", &Region::SetTag, &Region::GetTag, {}, "a finite number");
    filter->SetRegion(Region::FUNCTION);
  }
  expectRealRange<Condition>(
    condition, "Value", &Condition::SetValue, &Condition::GetValue, {}, "a finite number");
  condition->SetCondition(Condition::ROBIN);
  expectRealRange<Condition>(condition, "Coefficient", &Condition::SetCoefficient,
    &Condition::GetCoefficient, { { -1.0, "-1" } }, "at least 0");
  condition->SetCondition(Condition::SCREENING);
  expectRealRange<Condition>(condition, "Value", &Condition::SetValue, &Condition::GetValue,
    { { -1.0, "-1" } }, "at least 0");
  condition->SetCondition(Condition::DIRICHLET);
  this->Handle->SetMotion(Handle::SIMILARITY);
  expectRealRange<Handle>(this->Handle, "Scale", &Handle::SetScale, &Handle::GetScale,
    { { 0.0, "0" }, { -1.0, "-1" } }, "a number from 1e-20 to 1e+20");
  expectRealRange<Handle>(this->Handle, "RotationAngle", &Handle::SetRotationAngle,
    &Handle::GetRotationAngle, { { 2e6, "2e+06" } }, "a number from -1e+06 to 1e+06");
  this->Handle->SetMotion(Handle::FIXED);
  expectRange<Handle, int>(
    this->Handle, { "Motion", &Handle::SetMotion, &Handle::GetMotion, 0, 2 });
  expectRange<Condition, int>(
    condition, { "Condition", &Condition::SetCondition, &Condition::GetCondition, 0, 6 });
}

TEST_F(VtkPropertyRange, OfCoarserMeshes)
{
  using Simplification = vtkStreamingMeshSimplification;
  using Preview = vtkStreamingMeshPreview;
  vtkNew<Simplification> simplification;
  this->connect(*simplification);
  for (const vtkIdType number : { -1, 1, 3 })
  {
    simplification->SetNumberOfVertices(number);
    Errors said(simplification);
    EXPECT_NE(updatePiece(simplification, 0, 1), 1);
    EXPECT_TRUE(said.contain("NumberOfVertices is " + std::to_string(number) +
                             ": set it to a number from 4 to 1,099,511,627,776, or to 0 (none)."))
      << said.text();
  }
  simplification->SetNumberOfVertices(100);
  expectRealRange<Simplification>(simplification, "MaximumError", &Simplification::SetMaximumError,
    &Simplification::GetMaximumError, { { -1.0, "-1" } }, "a number above 0, or to 0 (none)");
  expectRange<Simplification, int>(simplification,
    { "MemoryLimit", &Simplification::SetMemoryLimit, &Simplification::GetMemoryLimit, 16 });
  expectRange<Simplification, int>(
    simplification, { "NumberOfPieces", &Simplification::SetNumberOfPieces,
                      &Simplification::GetNumberOfPieces, 0, Pieces });
  vtkNew<Preview> preview;
  this->connect(*preview);
  expectRange<Preview, int>(preview,
    { "PreviewPoints", &Preview::SetPreviewPoints, &Preview::GetPreviewPoints, 8, 1000000 });
  expectRange<Preview, int>(preview,
    { "NumberOfPieces", &Preview::SetNumberOfPieces, &Preview::GetNumberOfPieces, 0, Pieces });
}

TEST_F(VtkPropertyRange, OfReadersAndWriters)
{
  using Reader = vtkStreamingMeshReader;
  using Converter = vtkStreamingMeshConverter;
  using Writer = vtkStreamingMeshWriter;
  vtkNew<Converter> converter;
  converter->SetFileName((this->Folder / "mesh.vsm").c_str());
  converter->SetOutputFileName((this->Folder / "converted.vsm").c_str());
  for (Reader* reader : { static_cast<Reader*>(this->Reader), static_cast<Reader*>(converter) })
  {
    SCOPED_TRACE(reader->GetClassName());
    expectRange<Reader, vtkIdType>(
      reader, { "MaximumPointsInMemory", &Reader::SetMaximumPointsInMemory,
                &Reader::GetMaximumPointsInMemory, 0 });
    expectRange<Reader, int>(reader,
      { "PreviewPoints", &Reader::SetPreviewPoints, &Reader::GetPreviewPoints, 8, 1000000 });
    expectRange<Reader, int>(
      reader, { "PreviewCells", &Reader::SetPreviewCells, &Reader::GetPreviewCells, 0, 1 });
  }
  expectRange<Converter, int>(
    converter, { "Order", &Converter::SetOrder, &Converter::GetOrder, 0, 3 });
  expectRange<Converter, int>(
    converter, { "Cells", &Converter::SetCells, &Converter::GetCells, 0, 2 });
  expectRange<Converter, int>(
    converter, { "TimeStep", &Converter::SetTimeStep, &Converter::GetTimeStep, 0 });
  expectRange<Converter, int>(
    converter, { "Partition", &Converter::SetPartition, &Converter::GetPartition, -1 });
  for (const int number : { -1, 1, 15 })
  {
    converter->SetMemoryLimit(number);
    Errors said(converter);
    EXPECT_NE(updatePiece(converter, 0, 1), 1);
    EXPECT_TRUE(said.contain(
      "MemoryLimit is " + std::to_string(number) + ": set it to at least 16, or to 0 (automatic)."))
      << said.text();
  }
  converter->SetMemoryLimit(0);
  converter->SetWeld(true);
  expectRealRange<Converter>(converter, "WeldDistance", &Converter::SetWeldDistance,
    &Converter::GetWeldDistance, { { -1.0, "-1" } }, "at least 0");
  vtkNew<Writer> writer;
  this->connect(*writer);
  writer->SetFileName((this->Folder / "written.vsm").c_str());
  expectRange<Writer, int>(writer, { "NumberOfPieces", &Writer::SetNumberOfStreamedPieces,
                                     &Writer::GetNumberOfStreamedPieces, 0, Pieces });
}

} // namespace
} // namespace smg::testing
