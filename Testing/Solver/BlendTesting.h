// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/MemoryMesh.h"
#include "smg/Blend.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace smg::testing
{

/** A function of the position. */
using VertexFunction = std::function<double(const double*)>;

/** Adds a vertex column with the values of functions, one for each component. */
template <class T = double>
void addColumn(
  StreamMesh& mesh, const std::string& name, const std::vector<VertexFunction>& components)
{
  std::vector<T> values;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    for (const VertexFunction& component : components)
    {
      values.push_back(static_cast<T>(component(&mesh.positions[3 * v])));
    }
  }
  mesh.vertexColumns.push_back(makeColumn<T>(name, values, static_cast<int>(components.size())));
}

/** A smooth function. */
inline double smoothSignal(const double* p)
{
  return std::sin(1.3 * p[0]) + 0.5 * std::cos(1.7 * p[1] + p[2]);
}

/** One of four patches around the z axis. */
inline double quarter(const double* p)
{
  return (p[0] > 0.1 ? 1.0 : 0.0) + (p[1] > -0.05 ? 2.0 : 0.0);
}

/** The smooth function as recorded in each of these patches: with another gain and offset. */
inline double recordedSignal(const double* p)
{
  const double patch = quarter(p);
  return (1.0 + 0.05 * patch) * smoothSignal(p) + 2.0 * std::sin(2.0 * patch);
}

inline BlendDescription blendOf(std::vector<std::string> columns)
{
  BlendDescription description;
  description.patch = "patch";
  description.columns = std::move(columns);
  return description;
}

} // namespace smg::testing
