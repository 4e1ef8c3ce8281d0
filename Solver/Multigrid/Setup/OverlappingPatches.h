// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/RaggedRing.h"
#include "Solver/Memory/Ring.h"
#include "Solver/Multigrid/Setup/LevelRows.h"
#include "Solver/Multigrid/Setup/Patches.h"
#include "smg/Export.h"

#include <cstdint>

namespace smg
{

/**
 * The overlapping patches of a level, exact solves around the worst slivers (multiplicative
 * Schwarz): a patch in which the weights of a row cancel beyond `Cancelling`, with the nodes around
 * it that are coupled to it most strongly. A sweep that relaxes patches solves it when it has
 * relaxed the last member. As the members of a patch, these lie from its first node on and within
 * its rings: an overlapping patch is complete when the patch is, and what waits for patches waits
 * for it as well.
 *
 * On the finest level of solids: there they save a pass or two of nine to thirty and cost as much
 * processor time. Around patches that cancel less they cost more than they save.
 */
class SMG_EXPORT OverlappingPatches
{
public:
  using Patch = PatchUpTo<24>;
  using Matrix = PatchMatrixUpTo<Patch::Most>;

  /** Of the magnitudes of the weights of a row to its diagonal. */
  static constexpr double Cancelling = 2.0;

  explicit OverlappingPatches(Pool& pool)
    : Found(pool)
    , Triangles(pool)
    , LastWith(pool)
    , EndingAt(pool)
  {
  }

  /** Adds the next node. */
  void add()
  {
    this->LastWith.extend(this->LastWith.end() + 1);
    this->EndingAt.extend(this->EndingAt.end() + 1);
  }
  /** Adds the overlapping patch around `core`, if it has one, and returns the number of entries of
   * its matrix. Rows exist as far as the rings of `core` reach; patches come in the order of their
   * first nodes. */
  std::int64_t append(const LevelRows& rows, const smg::Patch& core, int rings);

  /** The last member of the patches with node i, or i. */
  std::int64_t last(std::int64_t i) const { return i + this->LastWith[i]; }
  /** Calls f(patch, lower triangle of its matrix) for the patches whose last member is node i. */
  template <class F>
  void forEndingAt(std::int64_t i, F&& f) const
  {
    for (std::uint32_t link = this->EndingAt[i]; link != 0; link = this->found(link).link)
    {
      f(this->found(link), static_cast<const double*>(this->Triangles.row(this->number(link))));
    }
  }

  /** Provides room for this number of further nodes. Until they are added nothing moves, so that
   * other threads may read earlier ones. */
  void reserve(std::int64_t nodes)
  {
    this->LastWith.reserveMore(nodes);
    this->EndingAt.reserveMore(nodes);
  }
  /** The same for further patches with this number of entries in all, until isFull(). */
  void reserve(std::int64_t patches, std::int64_t entries)
  {
    this->Found.reserveMore(patches);
    // As many as isFull() lets in: there is room by whole pages.
    this->Triangles.reserve(
      this->Found.capacity() - (this->Found.end() - this->Found.first()), entries);
  }
  bool isFull()
  {
    return this->Found.end() - this->Found.first() >= this->Found.capacity() ||
           !this->Triangles.hasRoom(Matrix::Entries);
  }

  /** Releases the nodes below `node` and the patches that end below it; if `node` is beyond the
   * end, it is the next node. */
  void release(std::int64_t node);

private:
  /** The number of a patch of which these are the low 32 bits, plus 1: a level has fewer than 2^32
   * - 1 of them. 0 is no link. */
  std::int64_t number(std::uint32_t link) const
  {
    const std::int64_t first = this->Found.first();
    return first + (link - 1 - static_cast<std::uint32_t>(first));
  }
  const Patch& found(std::uint32_t link) const { return this->Found[this->number(link)]; }

  Ring<Patch> Found;            // by number, with ascending first nodes; linked to another one that
                                // ends at the same node
  RaggedRing<double> Triangles; // by number
  Ring<std::int32_t> LastWith;  // by node: distance of the last member of patches with it
  Ring<std::uint32_t> EndingAt; // by node: link to the patches whose last member it is
};

} // namespace smg
