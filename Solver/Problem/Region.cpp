// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Region.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace smg
{

namespace
{

std::string complaintOf(const Region::HalfSpace& half)
{
  return half.normal == std::array<double, 3>{}
           ? "must have a direction: its first three numbers must not all be 0"
           : "";
}

std::string complaintOf(const Region::Box& box)
{
  const bool isInsideOut =
    box.low[0] > box.high[0] || box.low[1] > box.high[1] || box.low[2] > box.high[2];
  return isInsideOut ? "must be x0, y0, z0, x1, y1, z1 with x0 <= x1, y0 <= y1 and z0 <= z1" : "";
}

std::string complaintOf(const Region::Sphere& sphere)
{
  return sphere.radius >= 0.0 ? "" : "must have a radius of at least 0";
}

std::string complaintOf(const Region::Vertices& vertices)
{
  if (vertices.ids.empty())
  {
    return "must name at least one vertex";
  }
  return vertices.ids.front() < 0 ? "must name vertices by numbers from 0" : "";
}

Region::Vertices sorted(Region::Vertices vertices)
{
  std::ranges::sort(vertices.ids);
  vertices.ids.erase(std::unique(vertices.ids.begin(), vertices.ids.end()), vertices.ids.end());
  return vertices;
}

} // namespace

Region::Region(Vertices shape)
  : What(sorted(std::move(shape)))
{
}

std::string Region::complaint() const
{
  return std::visit([](const auto& shape) { return complaintOf(shape); }, this->What);
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
