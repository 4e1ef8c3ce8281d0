// SPDX-License-Identifier: BSD-3-Clause
// position_error A.vsm B.vsm : prints the largest distance between the positions of a vertex in two
// streams of the same cells in the same order, as two deformations of a mesh are. Only a block of
// each is in memory.

#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

namespace
{

double largestDistance(const std::string& file, const std::string& other)
{
  const auto one = smg::VsmReader(file).source({}, {}), two = smg::VsmReader(other).source({}, {});
  smg::MeshBlock a, b;
  double largest = 0.0;
  while (one->next(a))
  {
    if (!two->next(b) || a.positions.size() != b.positions.size() || a.corners != b.corners)
    {
      throw smg::Error(file + " and " + other + " have different cells.");
    }
    for (std::size_t i = 0; i < a.positions.size(); i += 3)
    {
      largest = std::max(largest,
        std::hypot(a.positions[i] - b.positions[i], a.positions[i + 1] - b.positions[i + 1],
          a.positions[i + 2] - b.positions[i + 2]));
    }
  }
  return largest;
}

} // namespace

int main(int argc, char** argv)
try
{
  CLI::App app("The largest distance between the positions of two streams.");
  std::string file, other;
  app.add_option("A", file, "A .vsm file")->required()->check(CLI::ExistingFile);
  app.add_option("B", other, "Another one")->required()->check(CLI::ExistingFile);
  CLI11_PARSE(app, argc, argv);
  std::cout << largestDistance(file, other) << '\n';
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "position_error: " << error.what() << '\n';
  return 1;
}
