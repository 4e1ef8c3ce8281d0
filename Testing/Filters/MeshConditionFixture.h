// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/vtkMeshCondition.h"
#include "Filters/vtkStreamingPoisson.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "Testing/IO/PieceTesting.h"
#include "Testing/Support/DescribedMesh.h"
#include "Testing/Support/JsonAt.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/DescribedProblem.h"
#include "smg/DescriptionFiles.h"
#include "smg/SolvedMesh.h"
#include "smg/VsmReader.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace smg::testing
{

/** Values of an array of the points that are not ghosts, and of the cells, piece by piece. */
struct Results
{
  std::vector<double> solution, gradient, flux;
  bool operator==(const Results&) const = default;
};

inline void append(vtkDataArray* array, vtkIdType tuple, std::vector<double>& values)
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

  /** The results of a problem on the command line. */
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

  /** The results of the filter for its problem, in `pieces` pieces. */
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

} // namespace smg::testing
