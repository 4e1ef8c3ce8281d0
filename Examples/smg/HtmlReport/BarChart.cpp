// SPDX-License-Identifier: BSD-3-Clause
#include "HtmlReport/Charts.h"
#include "HtmlReport/Text.h"

#include <algorithm>

namespace html
{

namespace
{

constexpr double RowHeight = 38.0, BarHeight = 12.0;

std::string rectangle(double x, double y, double width, const char* style)
{
  return "<rect class=\"" + std::string(style) + "\" x=\"" + number(x) + "\" y=\"" + number(y) +
         "\" width=\"" + number(width) + "\" height=\"" + number(BarHeight) + "\" rx=\"2\"/>";
}

/** The label and the value above a bar. */
std::string row(const Bar& bar, double y, double scale)
{
  std::string out = "<text class=\"" + std::string(bar.isPart ? "minor" : "label") + "\" x=\"" +
                    (bar.isPart ? "12" : "0") + "\" y=\"" + number(y + 12.0) + "\">" +
                    escape(bar.label) + "</text><text class=\"value\" x=\"" + number(FigureWidth) +
                    "\" y=\"" + number(y + 12.0) + "\" text-anchor=\"end\">" + escape(bar.value) +
                    "</text>" + rectangle(0.0, y + 18.0, FigureWidth, "track");
  const double first = bar.length * scale, second = bar.second * scale;
  if (bar.length > 0.0)
  {
    out += rectangle(0.0, y + 18.0, std::max(first, 2.0), bar.isPart ? "part" : "first");
  }
  if (bar.second > 0.0)
  {
    out += rectangle(first, y + 18.0, std::max(second, 2.0), "second");
  }
  return out;
}

} // namespace

std::string figure(const BarChart& chart)
{
  double most = chart.limit;
  for (const Bar& bar : chart.bars)
  {
    most = std::max(most, bar.length + bar.second);
  }
  const double scale = most > 0.0 ? FigureWidth / most : 0.0;
  const double rows = RowHeight * static_cast<double>(chart.bars.size());
  const double height = rows + (chart.limit > 0.0 ? 20.0 : 0.0);
  std::string out = "<figure><svg role=\"img\" viewBox=\"0 0 " + number(FigureWidth) + ' ' +
                    number(height) + "\"><title>" + escape(chart.title) + "</title>";
  for (std::size_t i = 0; i < chart.bars.size(); ++i)
  {
    out += row(chart.bars[i], RowHeight * static_cast<double>(i), scale);
  }
  if (chart.limit > 0.0)
  {
    const double x = std::min(chart.limit * scale, FigureWidth - 1.0);
    const bool isRight = x > FigureWidth / 2.0;
    // Across each bar, but not through the texts above it.
    out += "<path class=\"limit\" d=\"";
    for (double y = 15.0; y < rows; y += RowHeight)
    {
      out += 'M' + number(x) + ' ' + number(y) + "v18";
    }
    out += "\"/><text class=\"limit-text\" x=\"" + number(x) + "\" y=\"" + number(rows + 17.0) +
           "\" text-anchor=\"" + (isRight ? "end" : "start") + "\">" + escape(chart.limitText) +
           "</text>";
  }
  out += "</svg><figcaption>";
  for (std::size_t i = 0; i < chart.parts.size(); ++i)
  {
    out += "<span class=\"key " + std::string(i == 0 ? "first" : "second") + "\"></span>" +
           escape(chart.parts[i]) + " &nbsp; ";
  }
  return out + escape(chart.caption) + "</figcaption></figure>\n";
}

} // namespace html
