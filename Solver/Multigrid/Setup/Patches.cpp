// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/Patches.h"

#include <algorithm>
#include <span>

namespace smg
{
namespace
{

/** The last node that a patch may have which begins at `first`, as far as rows exist. */
std::int64_t lastOf(const LevelRows& rows, std::int64_t first, int rings)
{
  const std::int64_t ring = rows.reach(first);
  return rings > 1 && ring < rows.end() ? rows.reach(ring) : ring;
}

} // namespace

/** Whether row i, with this diagonal, has negative weights that count. */
bool cancels(const LevelRows& rows, std::int64_t i, double diagonal)
{
  constexpr double Least = 1.05;
  return static_cast<double>(rows.magnitudes(i)) > Least * diagonal;
}

PatchMatrix matrixOf(const LevelRows& rows, const Patch& patch)
{
  PatchMatrix matrix;
  matrix.order = patch.size;
  for (int a = 0; a < patch.size; ++a)
  {
    const std::int64_t i = patch.member(a);
    matrix.at(a, a) = rows.diagonal(i);
    const auto row = rows.row(i);
    const std::span<const double> precise = rows.precise(i);
    std::size_t e = 0;
    for (int b = 0; b < a; ++b)
    {
      const auto delta = static_cast<std::int32_t>(patch.member(b) - i);
      while (e < row.size() && row[e].delta() < delta)
      {
        ++e;
      }
      if (e < row.size() && row[e].delta() == delta)
      {
        matrix.at(a, b) = precise.empty() ? -static_cast<double>(row[e].weight()) : -precise[e];
      }
    }
  }
  return matrix;
}

void Patches::add(const LevelRows& rows)
{
  const std::int64_t j = this->Number.end();
  this->Number.extend(j + 1);
  this->Diagonals.extendRaw(j + 1);
  const double diagonal = rows.diagonal(j);
  this->Diagonals[j] = static_cast<float>(diagonal);
  const float* diagonals = this->Diagonals.at(j);
  // In descending order, as many as a patch has room for.
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

/** Makes one patch of those of nodes j, the last one, and i, either of which may be alone, if it
 * has room and nobody may have read them yet. */
void Patches::join(const LevelRows& rows, std::int64_t j, std::int64_t i)
{
  std::uint32_t number = this->Number[i];
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
  std::sort(members, members + size);
  if (size > Patch::Most || lastOf(rows, members[0], this->Rings) < j)
  {
    return;
  }
  if (number == Alone)
  {
    number = this->Number[j];
  }
  else if (this->Number[j] != Alone)
  {
    this->patch(this->Number[j]).size = 0; // a patch that is left out has no members
  }
  if (number == Alone)
  {
    std::int64_t next = this->Of.end();
    next += static_cast<std::uint32_t>(next) == Alone ? 1 : 0;
    this->Of.extend(next + 1);
    number = static_cast<std::uint32_t>(next);
  }
  Patch& patch = this->patch(number);
  patch.first = members[0];
  patch.size = size;
  for (int k = 0; k < size; ++k)
  {
    patch.offset[k] = static_cast<std::int32_t>(members[k] - members[0]);
    this->Number[members[k]] = number;
  }
}

void Patches::release(std::int64_t node)
{
  if (node > this->Number.end())
  {
    this->Of.release(node); // there are at least as many nodes as patches
  }
  this->Number.release(node);
  this->Diagonals.release(node);
  const auto isDone = [node](const Patch& patch) { return patch.size == 0 || patch.last() < node; };
  while (this->Of.first() < this->Of.end() && isDone(this->Of[this->Of.first()]))
  {
    this->Of.release(this->Of.first() + 1);
  }
}

} // namespace smg
