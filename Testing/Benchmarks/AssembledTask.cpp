// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/AssembledTask.h"

#include "Testing/Benchmarks/FixedEndsProblem.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <cmath>
#include <fstream>

namespace smg::benchmark
{
namespace
{

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

} // namespace

testing::DirectSystem assemble(const Task& task)
{
  const VsmReader reader(task.mesh);
  const auto& columns = reader.info().cellColumns;
  const bool hasFlags = std::any_of(columns.begin(), columns.end(),
    [](const ColumnSpec& column) { return column.name == CellFlagsName; });
  const auto source = reader.source(
    {}, hasFlags ? std::vector<std::string>{ CellFlagsName } : std::vector<std::string>{});
  FixedEndsProblem problem(reader.info(), task.start);
  return testing::assembleDirect(*source, problem);
}

double goalOfColumns(const Task& task, const testing::DirectSystem& system)
{
  return task.tolerance * system.residualOfConstants() /
         std::sqrt(static_cast<double>(system.rightSide.cols()));
}

void writeSolution(const Task& task, const Eigen::MatrixXd& values)
{
  const RowMajor rows = values;
  std::ofstream file(task.solution, std::ios::binary);
  file.write(reinterpret_cast<const char*>(rows.data()),
    static_cast<std::streamsize>(rows.size() * sizeof(double)));
  if (!file.flush())
  {
    throw Error(task.solution.string() + ": cannot be written.");
  }
}

Eigen::MatrixXd readSolution(const Task& task, Eigen::Index vertices)
{
  RowMajor rows(vertices, 3);
  std::ifstream file(task.solution, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(rows.data()),
        static_cast<std::streamsize>(rows.size() * sizeof(double))))
  {
    throw Error(task.solution.string() + ": does not hold 3 doubles for each vertex.");
  }
  return rows;
}

nlohmann::json checkSolution(const Task& task)
{
  const testing::DirectSystem system = assemble(task);
  const Eigen::MatrixXd values = readSolution(task, system.values.rows());
  return { { "relative_residual", system.relativeResidual(values) } };
}

} // namespace smg::benchmark
