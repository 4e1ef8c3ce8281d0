// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Hierarchy/Patches.h"

namespace smg
{

void Patches::add(const LevelRows& rows)
{
  const std::int64_t j = this->Number.end();
  this->Number.extend(j + 1);
  this->Diagonals.extendRaw(j + 1);
  const double diagonal = rows.diagonal(j);
  this->Diagonals[j] = static_cast<float>(diagonal);
  const float* diagonals = this->Diagonals.at(j);
  const std::uint32_t* numbers = this->Number.at(j);
  double strongest = Strong * Strong * diagonal;
  std::int64_t partner = -1;
  for (const RowEntry& entry : rows.row(j))
  {
    const std::int32_t delta = entry.delta();
    if (delta > 0)
    {
      break;
    }
    const double weight = entry.weight();
    const double coupling = weight * weight / static_cast<double>(diagonals[delta]);
    if (!(coupling > strongest))
    {
      continue;
    }
    const std::int64_t i = j + delta;
    const Patch* patch = numbers[delta] == Alone ? nullptr : this->of(i);
    if (!patch || (patch->size < PatchMatrix::Most && rows.reach(patch->first) >= j))
    {
      strongest = coupling;
      partner = i;
    }
  }
  if (partner >= 0)
  {
    this->join(rows, j, partner);
  }
}

/** Adds node j to the patch of node i, which may be alone. */
void Patches::join(const LevelRows& rows, std::int64_t j, std::int64_t i)
{
  if (this->Number[i] == Alone)
  {
    std::int64_t number = this->Of.end();
    number += static_cast<std::uint32_t>(number) == Alone ? 1 : 0;
    this->Of.extend(number + 1); // a patch that is left out has no members
    Patch& patch = this->Of[number];
    patch.first = i;
    append(rows, patch, i, rows.diagonal(i));
    this->Number[i] = static_cast<std::uint32_t>(number);
  }
  this->Number[j] = this->Number[i];
  append(rows, this->patch(this->Number[i]), j, rows.diagonal(j));
}

void Patches::append(const LevelRows& rows, Patch& patch, std::int64_t j, double diagonal)
{
  const int own = patch.size++;
  patch.offset[own] = static_cast<std::int32_t>(j - patch.first);
  patch.matrix.order = patch.size;
  patch.matrix.at(own, own) = diagonal;
  const auto row = rows.row(j);
  const std::span<const double> precise = rows.precise(j);
  for (int k = 0; k < own; ++k)
  {
    const auto delta = static_cast<std::int32_t>(patch.member(k) - j);
    for (std::size_t e = 0; e < row.size() && row[e].delta() <= delta; ++e)
    {
      if (row[e].delta() == delta)
      {
        patch.matrix.at(own, k) =
          precise.empty() ? -static_cast<double>(row[e].weight()) : -precise[e];
      }
    }
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
