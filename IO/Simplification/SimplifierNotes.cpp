// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/StreamSimplifier.h"

#include "Solver/Mesh/StreamCheck.h"

#include <cmath>
#include <cstdio>

namespace smg
{

void noteBodies(const StreamSimplifier& simplifier, std::vector<std::string>& notes)
{
  if (const std::int64_t dropped = simplifier.counts().dropped; dropped > 0)
  {
    notes.push_back(std::to_string(dropped) + (dropped == 1 ? " body" : " bodies") +
                    " too small for so few vertices " + (dropped == 1 ? "is" : "are") +
                    " left out.");
  }
}

void noteShape(const StreamSimplifier& simplifier, bool coincide, std::vector<std::string>& notes)
{
  constexpr double Tolerance = 0.2;
  const SimplificationCounts& counts = simplifier.counts();
  if (counts.welded > 0)
  {
    notes.push_back(
      "So few vertices are not enough for the sides of seams: " + std::to_string(counts.welded) +
      (counts.welded == 1 ? " point was" : " points were") +
      " joined with others at the same places, with the columns of one side.");
  }
  std::string text;
  if (counts.merged > 0)
  {
    text = "Collapsing edges alone leaves more vertices: " + std::to_string(counts.merged) +
           (counts.merged == 1 ? " was" : " were") +
           " merged with others near them instead, by an error that is not known.";
    text += coincide ? " If triangles do not share their vertices, join those with the same "
                       "coordinates first " +
                         std::string(HowToWeld) + '.'
                     : "";
  }
  const double area = simplifier.shareOfArea();
  if ((counts.merged > 0 || counts.turns) && std::fabs(area - 1.0) > Tolerance)
  {
    char percent[64];
    std::snprintf(percent, sizeof(percent), "The result has %.2g %% of the area.", 100.0 * area);
    text += (text.empty() ? "So few vertices are not enough for the surface: triangles turn over. "
                          : " ") +
            std::string(percent);
  }
  if (!text.empty())
  {
    notes.push_back(text);
  }
}

} // namespace smg
