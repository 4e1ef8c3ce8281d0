// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/Patches.h"

#include <algorithm>

// Patches: groups of up to twelve nodes that Gauss-Seidel relaxes together, found greedily in one
// sweep over the rows of a level. Each new node is compared with its lower neighbours only, so the
// patches depend on the stream order but not on the window, and they are complete as soon as the
// rings of their first node have arrived.
//
// Patches are what the sweeps need on slivers, see docs/architecture.md ("The hierarchy"). The
// dense matrix of a patch is kept until its inverse is packed into a block; a patch of n nodes
// costs 8 n (n + 1) / 2 bytes for it.

namespace smg
{

// Where row `ring` does not exist yet, all existing rows lie within the first ring, whose bound
// then suffices.
std::int64_t lastOf(const LevelRows& rows, std::int64_t first, int rings)
{
  const std::int64_t ring = rows.reach(first);
  return rings > 1 && ring < rows.end() ? rows.reach(ring) : ring;
}

/** Whether row i, with this diagonal, has negative weights that count: the magnitudes of its
 * weights exceed the diagonal by more than 5 %. */
static bool cancels(const LevelRows& rows, std::int64_t i, double diagonal)
{
  constexpr double Least = 1.05;
  return static_cast<double>(rows.magnitudes(i)) > Least * diagonal;
}

/** Adds node j: collects its strongest couplings to lower neighbours, then joins patches along
 * them. */
void Patches::add(const LevelRows& rows)
{
  const std::int64_t j = this->Number.end();
  this->Number.extend(j + 1);
  this->Diagonals.extendRaw(j + 1);
  const double diagonal = rows.diagonal(j);
  this->Diagonals[j] = static_cast<float>(diagonal);
  // Relative to node j: diagonals[delta] is that of its neighbour.
  const float* diagonals = this->Diagonals.at(j);
  // The strongest couplings in descending order; a patch has no room for more. The strongest are
  // joined first, since later ones may find the patch full.
  Coupling strongest[Patch::Most];
  int size = 0;
  for (const RowEntry& entry : rows.row(j))
  {
    const std::int32_t delta = entry.delta();
    if (delta > 0)
    {
      break;
    }
    const double weight = entry.weight();
    // The coupling squared, times the diagonal of j, which is the same for all: no root and one
    // division.
    const double square = weight * weight / static_cast<double>(diagonals[delta]);
    if (!(square > Strong * Strong * diagonal) ||
        (size == Patch::Most && !(square > strongest[size - 1].square)))
    {
      continue;
    }
    int place = size < Patch::Most ? size++ : size - 1;
    for (; place > 0 && strongest[place - 1].square < square; --place)
    {
      strongest[place] = strongest[place - 1];
    }
    strongest[place] = { square, j + delta };
  }
  // Between Strong and StrongAlone a coupling counts only where weights cancel.
  const bool isOfSlivers = size > 0 && cancels(rows, j, diagonal);
  for (int k = 0; k < size; ++k)
  {
    const auto [square, i] = strongest[k];
    if (square > StrongAlone * StrongAlone * diagonal || isOfSlivers ||
        cancels(rows, i, static_cast<double>(this->Diagonals[i])))
    {
      this->join(rows, j, i);
    }
  }
}

/** Joins the patches of nodes j, the last node, and i; either may be alone. Nothing happens if
 * the result would be too large or would reach beyond the rings of its first node: a stage may
 * already have taken the patch of that node as complete. */
void Patches::join(const LevelRows& rows, std::int64_t j, std::int64_t i)
{
  std::uint32_t number = this->Number[i];
  // Already together, by a stronger coupling.
  if (number != Alone && number == this->Number[j])
  {
    return;
  }
  std::int64_t members[2 * Patch::Most];
  int size = 0;
  for (const std::int64_t node : { i, j })
  {
    const Patch* patch = this->of(node);
    for (int k = 0; k < (patch ? patch->size : 1); ++k)
    {
      members[size++] = patch ? patch->member(k) : node;
    }
  }
  // The order of members is that of the stream, whatever the order of joining.
  std::sort(members, members + size);
  if (size > Patch::Most || lastOf(rows, members[0], this->Rings) < j)
  {
    return;
  }
  // The patch of i takes the members; failing that, the patch of j; failing that, a new one.
  if (number == Alone)
  {
    number = this->Number[j];
  }
  else if (this->Number[j] != Alone)
  {
    this->patch(this->Number[j]).size = 0; // abandoned: it has no members any more
  }
  if (number == Alone)
  {
    std::int64_t next = this->ByNumber.end();
    // Numbers are stored by their low 32 bits: skip the one that would look like Alone.
    next += static_cast<std::uint32_t>(next) == Alone ? 1 : 0;
    this->ByNumber.extend(next + 1);
    number = static_cast<std::uint32_t>(next);
  }
  this->patch(number).setMembers({ members, static_cast<std::size_t>(size) });
  for (int k = 0; k < size; ++k)
  {
    this->Number[members[k]] = number;
  }
}

void Patches::release(std::int64_t node)
{
  if (node > this->Number.end())
  {
    this->ByNumber.release(node); // there are at least as many nodes as patches
  }
  this->Number.release(node);
  this->Diagonals.release(node);
  // Patches are released in the order of their numbers: one that is still needed keeps those after
  // it.
  const auto isDone = [node](const Patch& patch) { return patch.size == 0 || patch.last() < node; };
  while (
    this->ByNumber.first() < this->ByNumber.end() && isDone(this->ByNumber[this->ByNumber.first()]))
  {
    this->ByNumber.release(this->ByNumber.first() + 1);
  }
}

} // namespace smg
