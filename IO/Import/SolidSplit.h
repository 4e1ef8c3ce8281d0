// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** The tetrahedra of a solid cell. */
class TetrahedraOfSolid
{
public:
  /** Adds a tetrahedron, unless two of its corners are equal, as in a collapsed solid. */
  void add(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d)
  {
    if (a == b || a == c || a == d || b == c || b == d || c == d)
    {
      return;
    }
    this->Cells[this->Count++] = { a, b, c, d };
  }
  std::span<const std::array<std::int64_t, 4>> all() const&
  {
    return { this->Cells.data(), this->Count };
  }
  std::span<const std::array<std::int64_t, 4>> all() const&& = delete; ///< it would dangle

private:
  std::array<std::array<std::int64_t, 4>, 6> Cells{};
  std::size_t Count = 0;
};

/**
 * Splits a hexahedron (8 corners), wedge (6) or pyramid (5), with corners in VTK's order, into
 * tetrahedra of the same orientation. Every quadrilateral is split along the diagonal of its least
 * corner, so that neighbours of any type match; if corners coincide there are fewer tetrahedra, or
 * none (Dompierre et al., How to subdivide pyramids, prisms and hexahedra into tetrahedra, 1999).
 */
TetrahedraOfSolid splitSolid(std::span<const std::int64_t> corners);

} // namespace smg
