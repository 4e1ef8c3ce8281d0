// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "Solver/Jobs/Distance/FrontRoot.h"
#include "Solver/Jobs/Distance/MarchWindow.h"

#include <array>
#include <cstdint>

namespace smg
{

/**
 * Whether straight lines through tetrahedra stay inside the mesh: a line is followed from face to
 * face of the window, until it comes to its end or to a face whose corners all have seen that.
 * Cost: the cells that the line crosses, 3 on average.
 */
class LineOfSight
{
public:
  LineOfSight(const MarchWindow& window, Pool& pool);

  /** The bytes for a window of this many vertices. */
  static constexpr std::int64_t bytes(std::int64_t vertices)
  {
    return vertices * std::int64_t(sizeof(std::uint32_t));
  }

  /** Whether vertex w sees a root. Then `face` are the corners of the face through which the line
   * leaves the cells of w. A line that leaves the window, or crosses many cells before it comes to
   * what sees the root, counts as not seen. */
  bool sees(std::uint32_t w, const FrontRoot& root, std::array<std::uint32_t, 3>& face);
  /** Lines that were not seen may be seen by now: the window has moved. */
  void forget();

private:
  /** Lines through more cells are given up. */
  static constexpr int MostCells = 64;

  /** A corner seen along the line: in the plane across it, and how far along it. */
  struct View
  {
    double x, y, along;
  };
  using Face = std::array<std::uint32_t, 3>;

  /** A face that the line crosses. */
  struct Step
  {
    Face face{};
    std::uint32_t corner = MarchWindow::NoVertex; ///< of the cell beyond it
    bool arrives = false;                         ///< whether the line need not be followed on
  };

  void look(std::uint32_t w, const FrontRoot& root);
  View viewOf(std::uint32_t vertex) const;
  /** Finds the face opposite to w that the line crosses. */
  bool leave(std::uint32_t w, const FrontRoot& root, Step& step) const;
  /** Sets the step through a face of the cell of corner `passed`, unless that is at the boundary,
   * or at the end of the window. */
  bool pass(const Face& face, std::uint32_t passed, const FrontRoot& root, Step& step) const;
  /** The corner of the cell beyond a face, NoVertex if there is none in the window. */
  std::uint32_t beyond(const Face& face, std::uint32_t passed) const;
  /** Goes on through the cell beyond a face. */
  bool follow(const FrontRoot& root, Step& step) const;

  const MarchWindow& Window;
  /** Of each vertex, a digest of the last line that was not seen: many neighbours propose the same
   * one. */
  Buffer Memory;
  std::uint32_t* Unseen;
  const double* Origin = nullptr;
  Vector Along{}, Across[2]{};
};

} // namespace smg
