// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** The tetrahedra that a solid cell is cut into. */
class TetrahedraOfSolid
{
public:
  /** Adds a tetrahedron, unless two of its corners are the same: those of a collapsed solid. */
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
 * Cuts a hexahedron (8 corners), wedge (6) or pyramid (5), corners in VTK's order, into tetrahedra
 * of the same orientation. Every quadrilateral is cut along the diagonal of its least corner, so
 * that neighbours fit together whatever they are; where corners fall together there are fewer
 * tetrahedra, or none (Dompierre et al., How to subdivide pyramids,
 * prisms and hexahedra into tetrahedra, 1999).
 */
TetrahedraOfSolid splitSolid(std::span<const std::int64_t> corners);

} // namespace smg
