// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace html
{

/** The width of all figures in units of their coordinates, which are pixels where there is room. */
inline constexpr double FigureWidth = 520.0;

/** A horizontal bar of a chart. All texts are plain. */
struct Bar
{
  std::string label;
  std::string value; ///< the length as a text
  double length = 0.0;
  double second = 0.0; ///< a second part, after the first
  bool isPart = false; ///< of bars above, not a term of its own
};

/** Bars of one unit from a common zero, as a figure. All texts are plain. */
struct BarChart
{
  std::string title; ///< what a reader of the screen calls it
  std::vector<Bar> bars;
  double limit = 0.0;    ///< a line across the bars; 0: none
  std::string limitText; ///< what that is
  std::string caption;
  std::vector<std::string> parts = {}; ///< what the two parts of all bars are; empty: one part
};
std::string figure(const BarChart& chart);

/** The residuals of an iteration. */
struct ResidualChart
{
  /** The relative residual after each V-cycle of a step; one that is not a number is not drawn. */
  struct Step
  {
    std::string name; ///< empty: the only one
    std::vector<double> residuals;
  };
  std::vector<Step> steps;
  std::string iterations = "V-cycles"; ///< what the horizontal axis counts
  double tolerance = 0.0;              ///< a line; 0: none
  std::string caption;
};
std::string figure(const ResidualChart& chart);

} // namespace html
