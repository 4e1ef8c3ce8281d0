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
  /** Whether vertex w sees its nearest source, by a line that leaves a cell of w through the face
   * opposite to w, and soon comes to a face whose corners all see theirs. */
  bool seesNearest(std::uint32_t w, std::array<std::uint32_t, 3> face);
  /** Whether the distance of a vertex is that of its nearest source. */
  bool hasNearest(std::uint32_t vertex) const
  {
    return this->Window.distance()[vertex] <=
           this->Window.nearest(vertex).distance * (1 + Straightness);
  }
  /** Lines that were not seen may be seen by now: the window has moved. */
  void forget();

private:
  /** Lines through more cells are given up. */
  static constexpr int MostCells = 64, MostToNearest = 16;
  /** A distance that is longer by at most this share is that of the straight line. */
  static constexpr double Straightness = 1e-6;

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

  /** Begins a line from w to a root, or to the nearest source of w if none is given. */
  void look(std::uint32_t w, const FrontRoot* root);
  View viewOf(std::uint32_t vertex) const;
  /** The areas of a projected face beside its edges ab, bc and ca, as seen from the line, their
   * sum, and that times how far along the line its plane is met. */
  struct Projection
  {
    double ab, bc, ca, whole, along;
  };
  Projection projected(const Face& face) const;
  /** Whether the line crosses a face opposite to w, whose corners are put in order for it. */
  bool crosses(Face& face) const;
  /** Finds the face opposite to w that the line crosses. */
  bool leave(std::uint32_t w, Step& step) const;
  bool isRoot(std::uint32_t vertex) const;
  /** Whether the line comes to its end by a face. */
  bool endsAt(const Face& face) const;
  /** Whether all corners of a face see what the line leads to. */
  bool hasSeen(const Face& face) const;
  /** Sets the step through a face of the cell of corner `passed`, unless that is at the boundary,
   * or at the end of the window. */
  bool pass(const Face& face, std::uint32_t passed, Step& step) const;
  /** The corner of the cell beyond a face, NoVertex if there is none in the window. */
  std::uint32_t beyond(const Face& face, std::uint32_t passed) const;
  /** Goes on through the cell beyond a face. */
  bool follow(Step& step) const;
  /** Follows the line through at most this many cells; returns whether it arrives. */
  bool arrives(Step& step, int mostCells) const;

  const MarchWindow& Window;
  /** Of each vertex, a digest of the last line that was not seen: many neighbours propose the same
   * one. */
  Buffer Memory;
  std::uint32_t* Unseen;
  const FrontRoot* Root = nullptr; ///< null: the nearest source
  const double* Origin = nullptr;
  Vector Along{}, Across[2]{};
};

} // namespace smg
