// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Results/BodyFlows.h"
#include "smg/Report.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace smg
{

/** Judges how far the fluxes of a report are known: what bodies leave, column by column. */
class KnownFluxes
{
public:
  /** `hasRest`: whether the values of the solution have more digits than a double. */
  KnownFluxes(const BodyFlows& bodies, Report& report, bool hasRest);

  /** Judges column k, and makes the fluxes NaN of which no digit is known. */
  struct Column
  {
    double all;  ///< the magnitudes of what flows; 0: nothing does
    bool isLost; ///< whether any flux is NaN
  };
  Column judge(std::size_t k);
  /** Warns of the fluxes that are not known, and of those that are known to few digits; `rest` is
   * what misses in the worst balance, relative to all that flows. */
  void warn(double rest);

private:
  /** What flows in a body. */
  struct Flow
  {
    double all = 0.0;   ///< sum of the magnitudes of what flows in and out; 0: nothing does
    double least = 0.0; ///< what flows through the whole
    bool varies = false;
  };
  /** What holds a body. */
  struct Hold
  {
    double sum = 0.0; ///< of the row sums of screening and Robin conditions
    int firm = 0;     ///< Dirichlet conditions
  };

  /** What is known of the flux of a condition. */
  struct Known
  {
    Flow flow;             ///< through the bodies in which it holds
    double doubt = 0.0;    ///< what the flux may be wrong by
    double share = 0.0;    ///< the largest one of what flows in a body, if that is worth a warning
    bool helps = false;    ///< whether a smaller tolerance does
    bool isOffset = false; ///< whether values have lost digits, since they are nearly equal
  };

  Flow flowIn(std::int32_t body, std::size_t k) const;
  double doubt(std::int32_t body, double rowSum, const Flow& flow, std::size_t k) const;
  void add(Known& known, std::int32_t body, double rowSum, std::size_t k) const;

  const BodyFlows& Bodies;
  Report& Into;
  bool HasRest;
  std::vector<std::size_t> Places;    // in the report, of the conditions of the bodies
  std::map<std::int32_t, Hold> Holds; // of the bodies that conditions hold
  std::set<std::size_t> Lost, Few;    // conditions of the report whose fluxes have no digits; few
  double LostBy = 0.0;                // the largest doubt of the first ones
  Known Worst;                        // of the others
};

} // namespace smg
