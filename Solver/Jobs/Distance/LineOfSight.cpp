// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/LineOfSight.h"

#include "Solver/Files/Checksum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>

// A line is followed in the plane across it: it crosses a face if the projected face contains the
// origin. Of the three faces by which it may leave a cell, it takes the one that contains the
// origin best, so that rounding at edges and vertices does not end the walk.

namespace smg
{

namespace
{

/** How far outside of a face, relative to the size of its projection, a line still crosses it. */
constexpr double FaceMargin = 1e-9;

/** Of a line from a root to a point. */
std::uint32_t digest(const FrontRoot& root, const double* point)
{
  const double numbers[] = { root.point[0], root.point[1], root.point[2], root.offset, point[0],
    point[1], point[2] };
  return static_cast<std::uint32_t>(checksum(std::as_bytes(std::span(numbers))));
}

} // namespace

LineOfSight::LineOfSight(const MarchWindow& window, Pool& pool)
  : Window(window)
  , Memory(pool,
      static_cast<std::size_t>(bytes(
        window.hasRoots() ? std::min(window.mesh().plan.window(), window.mesh().vertices) : 0)))
  , Unseen(reinterpret_cast<std::uint32_t*>(this->Memory.data()))
{
  this->forget();
}

void LineOfSight::look(std::uint32_t w, const FrontRoot* root)
{
  this->Root = root;
  this->Origin = this->Window.point(w);
  const Vector& end = root ? root->point : this->Window.nearest(w).point;
  this->Along = difference(end.data(), this->Origin);
  const auto smallest = std::ranges::min_element(
    this->Along, {}, [](double component) { return std::fabs(component); });
  Vector axis{};
  axis[static_cast<std::size_t>(smallest - this->Along.begin())] = 1;
  this->Across[0] = cross(this->Along, axis);
  const Vector second = cross(this->Along, this->Across[0]);
  this->Across[1] = scaled(1 / std::sqrt(dot(this->Along, this->Along)), second);
}

LineOfSight::View LineOfSight::viewOf(std::uint32_t vertex) const
{
  const Vector to = difference(this->Window.point(vertex), this->Origin);
  return { dot(to, this->Across[0]), dot(to, this->Across[1]), dot(to, this->Along) };
}

LineOfSight::Projection LineOfSight::projected(const Face& face) const
{
  const View a = this->viewOf(face[0]), b = this->viewOf(face[1]), c = this->viewOf(face[2]);
  const double ab = a.x * b.y - a.y * b.x, bc = b.x * c.y - b.y * c.x, ca = c.x * a.y - c.y * a.x;
  return { ab, bc, ca, ab + bc + ca, bc * a.along + ca * b.along + ab * c.along };
}

bool LineOfSight::crosses(Face& face) const
{
  const Projection seen = this->projected(face);
  const double sign = seen.whole < 0 ? -1 : 1, whole = sign * seen.whole;
  if (sign < 0)
  {
    std::swap(face[0], face[1]);
  }
  return whole > 0 && sign * seen.along > 0 &&
         std::min({ sign * seen.ab, sign * seen.bc, sign * seen.ca }) >= -FaceMargin * whole;
}

bool LineOfSight::leave(std::uint32_t w, Step& step) const
{
  bool isFound = false;
  this->Window.forCellsOf<4>(w,
    [&](const std::uint32_t* cell)
    {
      if (isFound)
      {
        return;
      }
      Face opposite{};
      std::size_t k = 0;
      for (int c = 0; c < 4; ++c)
      {
        if (cell[c] != w && k < 3)
        {
          opposite[k++] = cell[c];
        }
      }
      isFound = this->crosses(opposite) && this->pass(opposite, w, step);
    });
  return isFound;
}

bool LineOfSight::endsAt(const Face& face) const
{
  if (this->Root)
  {
    // A source has copies where a mesh is cut.
    return std::ranges::any_of(face, [this](std::uint32_t v) { return this->isRoot(v); });
  }
  // A point of the face, as far along the line as this crosses it.
  const Projection seen = this->projected(face);
  const double end = dot(this->Along, this->Along);
  return seen.whole != 0.0 && seen.along / seen.whole >= (1 - FaceMargin) * end;
}

bool LineOfSight::isRoot(std::uint32_t vertex) const
{
  return std::equal(
           this->Root->point.begin(), this->Root->point.end(), this->Window.point(vertex)) &&
         this->Window.distance()[vertex] <= this->Root->offset;
}

bool LineOfSight::hasSeen(const Face& face) const
{
  return std::ranges::all_of(face,
    [this](std::uint32_t v)
    {
      return this->Root ? this->Window.root(v) == *this->Root || this->isRoot(v)
                        : this->hasNearest(v);
    });
}

/** Beyond a face of the boundary there is nothing, though its corners have seen the end past it. */
bool LineOfSight::pass(const Face& face, std::uint32_t passed, Step& step) const
{
  const bool ends = this->endsAt(face);
  const std::uint32_t corner = ends ? passed : this->beyond(face, passed);
  if (corner == MarchWindow::NoVertex)
  {
    return false;
  }
  step = { face, corner, ends || this->hasSeen(face) };
  return true;
}

std::uint32_t LineOfSight::beyond(const Face& face, std::uint32_t passed) const
{
  std::uint32_t found = MarchWindow::NoVertex;
  this->Window.forCellsOf<4>(face[0],
    [&](const std::uint32_t* cell)
    {
      int shared = 0;
      std::uint32_t other = MarchWindow::NoVertex;
      for (int c = 0; c < 4; ++c)
      {
        const bool isShared = std::ranges::find(face, cell[c]) != face.end();
        shared += isShared ? 1 : 0;
        other = isShared ? other : cell[c];
      }
      found = shared == 3 && other != passed ? other : found;
    });
  return found;
}

bool LineOfSight::sees(std::uint32_t w, const FrontRoot& root, Face& face)
{
  const std::uint32_t line = digest(root, this->Window.point(w));
  if (this->Unseen[w] == line)
  {
    return false;
  }
  this->look(w, &root);
  Step step;
  const bool leaves = this->leave(w, step);
  face = step.face;
  const bool isSeen = leaves && this->arrives(step, MostCells);
  this->Unseen[w] = isSeen ? this->Unseen[w] : line;
  return isSeen;
}

bool LineOfSight::seesNearest(std::uint32_t w, Face face)
{
  this->look(w, nullptr);
  Step step;
  return this->crosses(face) && this->pass(face, w, step) && this->arrives(step, MostToNearest);
}

bool LineOfSight::arrives(Step& step, int mostCells) const
{
  bool goesOn = true;
  for (int cells = 1; goesOn && !step.arrives && cells < mostCells; ++cells)
  {
    goesOn = this->follow(step);
  }
  return goesOn && step.arrives;
}

bool LineOfSight::follow(Step& step) const
{
  // On which side of the way from each corner of the face to the new one the line lies.
  const View at = this->viewOf(step.corner);
  double side[3], size = 0, first = at.along;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const View view = this->viewOf(step.face[k]);
    side[k] = view.x * at.y - view.y * at.x;
    size += std::fabs(side[k]);
    first = std::min(first, view.along);
  }
  if (first >= dot(this->Along, this->Along))
  {
    // Beyond the end: a root is a vertex, and would have been seen.
    step.arrives = !this->Root;
    return step.arrives;
  }
  // The new corner takes the place of the one that leaves the line between the other two ways. Of
  // faces that the line touches alike, as in a plane boundary, one with a cell beyond it.
  std::array<std::size_t, 3> order{ 0, 1, 2 };
  const auto inside = [&side](std::size_t k)
  { return std::min(-side[(k + 1) % 3], side[(k + 2) % 3]); };
  std::ranges::sort(order, std::greater<>(), inside);
  return std::ranges::any_of(order,
    [&](std::size_t k)
    {
      Face next = step.face;
      next[k] = step.corner;
      return (k == order[0] || inside(k) >= -FaceMargin * size) &&
             this->pass(next, step.face[k], step);
    });
}

void LineOfSight::forget()
{
  std::fill_n(this->Unseen, this->Memory.size() / sizeof(std::uint32_t), 0U);
}

} // namespace smg
