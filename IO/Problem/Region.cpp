// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Problem/Region.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace smg
{

namespace
{

Region parseHalfSpace(const JsonNode& node)
{
  const std::vector<double> n = node.numbers(4);
  if (n[0] == 0.0 && n[1] == 0.0 && n[2] == 0.0)
  {
    node.fail("must have a direction: its first three numbers must not all be 0");
  }
  return Region(Region::HalfSpace{ { n[0], n[1], n[2] }, n[3] });
}

Region parseBox(const JsonNode& node)
{
  const std::vector<double> n = node.numbers(6);
  if (n[0] > n[3] || n[1] > n[4] || n[2] > n[5])
  {
    node.fail("must be x0, y0, z0, x1, y1, z1 with x0 <= x1, y0 <= y1 and z0 <= z1");
  }
  return Region(Region::Box{ { n[0], n[1], n[2] }, { n[3], n[4], n[5] } });
}

Region parseSphere(const JsonNode& node)
{
  const std::vector<double> n = node.numbers(4);
  if (n[3] < 0.0)
  {
    node.fail("must have a radius of at least 0");
  }
  return Region(Region::Sphere{ { n[0], n[1], n[2] }, n[3] });
}

Region parseVertices(const JsonNode& node)
{
  Region::Vertices vertices{ node.integers(0, std::numeric_limits<std::int64_t>::max()) };
  if (vertices.ids.empty())
  {
    node.fail("must name at least one vertex");
  }
  std::sort(vertices.ids.begin(), vertices.ids.end());
  vertices.ids.erase(std::unique(vertices.ids.begin(), vertices.ids.end()), vertices.ids.end());
  return Region(std::move(vertices));
}

} // namespace

Region Region::parse(const JsonNode& object)
{
  struct Shape
  {
    const char* key;
    Region (*parse)(const JsonNode&);
  };
  constexpr Shape shapes[] = { { "halfspace", parseHalfSpace }, { "box", parseBox },
    { "sphere", parseSphere }, { "vertices", parseVertices } };
  const auto given = [&object](const Shape& shape) { return object.has(shape.key); };
  if (std::count_if(std::begin(shapes), std::end(shapes), given) != 1)
  {
    object.fail("must have exactly one of halfspace, box, sphere and vertices");
  }
  const Shape& shape = *std::find_if(std::begin(shapes), std::end(shapes), given);
  return shape.parse(object.member(shape.key));
}

bool Region::contains(std::span<const double, 3> p, std::int64_t id) const
{
  if (const auto* half = std::get_if<HalfSpace>(&this->What))
  {
    return half->normal[0] * p[0] + half->normal[1] * p[1] + half->normal[2] * p[2] >=
           half->distance;
  }
  if (const auto* box = std::get_if<Box>(&this->What))
  {
    return p[0] >= box->low[0] && p[1] >= box->low[1] && p[2] >= box->low[2] &&
           p[0] <= box->high[0] && p[1] <= box->high[1] && p[2] <= box->high[2];
  }
  if (const auto* sphere = std::get_if<Sphere>(&this->What))
  {
    const double x = p[0] - sphere->center[0];
    const double y = p[1] - sphere->center[1];
    const double z = p[2] - sphere->center[2];
    return x * x + y * y + z * z <= sphere->radius * sphere->radius;
  }
  const std::vector<std::int64_t>& ids = std::get<Vertices>(this->What).ids;
  return std::binary_search(ids.begin(), ids.end(), id);
}

std::optional<std::array<double, 3>> Region::center() const
{
  if (const auto* sphere = std::get_if<Sphere>(&this->What))
  {
    return sphere->center;
  }
  if (const auto* box = std::get_if<Box>(&this->What))
  {
    std::array<double, 3> center{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      center[axis] = std::midpoint(box->low[axis], box->high[axis]);
    }
    return center;
  }
  return std::nullopt;
}

} // namespace smg
