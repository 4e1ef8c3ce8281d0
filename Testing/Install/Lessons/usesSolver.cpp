// SPDX-License-Identifier: BSD-3-Clause
// Solves a tiny problem with the installed library: a strip of triangles, values 0 and 1 at its
// ends, uniform weights.

#include <smg/Solve.h>

#include <cmath>
#include <iostream>

namespace
{

constexpr int Columns = 40;

/** Vertex 2i and 2i+1 lie at (i, 0) and (i, 1). */
class Strip : public smg::MeshSource
{
public:
  Strip()
  {
    this->Info.vertices = 2 * Columns;
    this->Info.cells = 2 * (Columns - 1);
    this->Info.bounds = { 0, Columns - 1, 0, 1, 0, 0 };
    this->Info.width = 4;
    this->Info.span = 3;
  }
  const smg::StreamInfo& info() const override { return this->Info; }
  bool next(smg::MeshBlock& block) override
  {
    if (this->Done)
    {
      return false;
    }
    this->Done = true;
    for (std::int64_t i = 0; i < Columns; ++i)
    {
      const double x = static_cast<double>(i);
      block.positions.insert(block.positions.end(), { x, 0, 0, x, 1, 0 });
      if (i > 0)
      {
        const std::int64_t v = 2 * i;
        block.corners.insert(block.corners.end(), { v - 2, v - 1, v, v - 1, v + 1, v });
      }
    }
    block.finalized = 2 * Columns;
    return true;
  }

private:
  smg::StreamInfo Info;
  bool Done = false;
};

class Ends : public smg::Problem
{
public:
  int columns() const override { return 1; }
  smg::Weights weights() const override { return smg::Weights::Uniform; }
  void conditions(const smg::MeshBlock& block, smg::VertexConditions& conditions) override
  {
    for (std::int64_t v = 0; v < block.vertices(); ++v)
    {
      const double x = block.positions[3 * v];
      conditions.dirichlet[v] = x == 0 || x == Columns - 1 ? 0 : -1;
      conditions.value[v] = x == Columns - 1 ? 1.0 : 0.0;
    }
  }
};

} // namespace

int main()
{
  Strip strip;
  Ends ends;
  smg::SolveOptions options;
  options.tolerance = 1e-10;
  const auto solution = smg::solve(strip, ends, options);

  double value[2] = {};
  solution->read(0, 2, value);
  const bool low = value[0] == 0 && value[1] == 0;
  solution->read(Columns, 2, value);
  const double middle = (value[0] + value[1]) / 2;
  std::cout << "value in the middle: " << middle << '\n';
  const double expected = (Columns / 2) / (Columns - 1.0);
  return low && solution->report().converged && std::abs(middle - expected) < 1e-2 ? 0 : 1;
}
