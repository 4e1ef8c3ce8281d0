// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/SavedSolution.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

namespace smg::benchmark
{

void saveSolution(Solution& solution, const std::filesystem::path& file)
{
  constexpr std::int64_t Stretch = 16384;
  std::vector<double> values;
  std::ofstream out(file, std::ios::binary);
  for (std::int64_t first = 0; first < solution.vertices(); first += Stretch)
  {
    const std::int64_t count = std::min(Stretch, solution.vertices() - first);
    values.resize(count * solution.columns());
    solution.read(first, count, values);
    out.write(reinterpret_cast<const char*>(values.data()),
      static_cast<std::streamsize>(values.size() * sizeof(double)));
  }
  if (!out.flush())
  {
    throw Error(file.string() + ": cannot be written.");
  }
}

double largestDistance(const std::filesystem::path& file, const std::filesystem::path& other)
{
  constexpr std::size_t Stretch = std::size_t(3) * 16384;
  if (file_size(file) != file_size(other))
  {
    throw Error(file.string() + " and " + other.string() + " are of different meshes.");
  }
  std::ifstream one(file, std::ios::binary), two(other, std::ios::binary);
  std::vector<double> a(Stretch), b(Stretch);
  const auto read = [](std::ifstream& in, std::vector<double>& values)
  {
    in.read(reinterpret_cast<char*>(values.data()),
      static_cast<std::streamsize>(values.size() * sizeof(double)));
    return static_cast<std::size_t>(in.gcount()) / sizeof(double);
  };
  double largest = 0.0;
  for (std::size_t count; (count = std::min(read(one, a), read(two, b))) > 0;)
  {
    for (std::size_t i = 0; i < count; i += 3)
    {
      largest =
        std::max(largest, std::hypot(a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]));
    }
  }
  return largest;
}

} // namespace smg::benchmark
