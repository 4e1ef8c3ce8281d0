// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/VaryingRightSide.h"

#include "Solver/Assembly/Components.h"

#include <algorithm>
#include <cmath>

// Sums are kept by the label that an unknown had, and are joined by component in the order of the
// labels: see Components.

namespace smg
{

void VaryingRightSide::add(
  std::int32_t label, double rowSum, double mass, const double* b, double share)
{
  const std::size_t body = std::min(static_cast<std::size_t>(label), this->Most);
  if ((body + 1) * this->Columns > this->Bodies.size())
  {
    this->Bodies.resize((body + 1) * this->Columns);
  }
  Body* of = this->Bodies.data() + body * this->Columns;
  for (std::size_t k = 0; k < this->Columns; ++k, ++of)
  {
    of->rowSums.add(share * rowSum, share * b[k]);
    of->masses.add(share * (mass > 0.0 ? mass : 1.0), share * b[k]);
    of->unknowns += 1.0;
  }
}

std::vector<double> VaryingRightSide::norms(const Components& components) const
{
  std::vector<double> norms;
  std::vector<Body> bodies(std::min(static_cast<std::size_t>(components.labels()), this->Most) + 1);
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    std::ranges::fill(bodies, Body{});
    for (std::size_t label = 0; label * this->Columns < this->Bodies.size(); ++label)
    {
      const Body& part = this->Bodies[label * this->Columns + k];
      const auto root = label < this->Most ? static_cast<std::size_t>(
                                               components.root(static_cast<std::int32_t>(label)))
                                           : label;
      Body& whole = bodies[std::min(root, this->Most)];
      whole.rowSums.join(part.rowSums);
      whole.masses.join(part.masses);
      whole.unknowns += part.unknowns;
    }
    norms.push_back(this->norm(bodies));
  }
  return norms;
}

double VaryingRightSide::norm(std::span<const Body> bodies) const
{
  double all = 0.0, rest = 0.0, unknowns = 0.0;
  for (const Body& body : bodies)
  {
    all += body.rowSums.hasConstant() ? body.rowSums.squares() : 0.0;
    rest += body.rest();
    unknowns += body.unknowns;
  }
  double least = rest;
  for (const Body& body : bodies)
  {
    // A body whose solution is constant has no range.
    if (const double own = body.rest(); own > 0.0)
    {
      least = std::min(least, own * (unknowns / body.unknowns));
    }
  }
  return rest > 0.0 ? std::max(std::sqrt(least), LeastShare * std::sqrt(rest))
                    : LeastShare * std::sqrt(all);
}

} // namespace smg
