// SPDX-License-Identifier: BSD-3-Clause
#include "HtmlReport/Charts.h"
#include "HtmlReport/Text.h"

#include <algorithm>
#include <cmath>

namespace html
{

namespace
{

constexpr double Height = 300.0, Left = 46.0, Right = 508.0, Top = 18.0, Bottom = 256.0;

/** The places of iterations and residuals in the figure: linear and logarithmic. */
struct Axes
{
  double iterations = 1.0;
  int lowest = -1, highest = 0; ///< powers of ten

  double x(double iteration) const { return Left + (Right - Left) * iteration / this->iterations; }
  double y(double residual) const
  {
    const double above = std::log10(residual) - this->lowest;
    return Bottom - (Bottom - Top) * above / (this->highest - this->lowest);
  }
};

Axes axesOf(const ResidualChart& chart)
{
  double least = chart.tolerance > 0.0 ? chart.tolerance : 0.1, most = 1.0, iterations = 0.0;
  for (const ResidualChart::Step& step : chart.steps)
  {
    iterations += static_cast<double>(step.residuals.size());
    for (const double residual : step.residuals)
    {
      if (std::isfinite(residual) && residual > 0.0)
      {
        least = std::min(least, residual);
        most = std::max(most, residual);
      }
    }
  }
  const double lowest = std::floor(std::log10(least) - 1e-9);
  return { std::max(iterations, 1.0), static_cast<int>(lowest),
    static_cast<int>(std::ceil(std::log10(most) - 1e-9)) };
}

/** 1, 2 or 5 times a power of ten, so that at most `most` steps of it make up `range`. */
double tidyStep(double range, int most)
{
  const double power = std::pow(10.0, std::floor(std::log10(range / most)));
  for (const double factor : { 1.0, 2.0, 5.0 })
  {
    if (factor * power * most >= range * (1.0 - 1e-9))
    {
      return factor * power;
    }
  }
  return 10.0 * power;
}

std::string text(const char* style, double x, double y, const char* anchor, const std::string& what)
{
  return "<text class=\"" + std::string(style) + "\" x=\"" + number(x) + "\" y=\"" + number(y) +
         "\" text-anchor=\"" + anchor + "\">" + escape(what) + "</text>";
}

std::string grid(const Axes& axes, const std::string& iterations)
{
  std::string out;
  const double step = std::max(tidyStep(axes.highest - axes.lowest, 8), 1.0);
  for (double power = axes.highest; power >= axes.lowest; power -= step)
  {
    const double y = axes.y(std::pow(10.0, power));
    out += "<path class=\"grid\" d=\"M" + number(Left) + ' ' + number(y) + 'H' + number(Right) +
           "\"/>" + text("tick", Left - 8.0, y + 4.0, "end", powerOfTen(static_cast<int>(power)));
  }
  const double stride = std::max(tidyStep(axes.iterations, 10), 1.0);
  for (double at = 0.0; at <= axes.iterations; at += stride)
  {
    out += "<path class=\"axis\" d=\"M" + number(axes.x(at)) + ' ' + number(Bottom) + "v5\"/>" +
           text("tick", axes.x(at), Bottom + 20.0, "middle", count(std::llround(at)));
  }
  return out + "<path class=\"axis\" d=\"M" + number(Left) + ' ' + number(Bottom) + 'H' +
         number(Right) + "\"/>" +
         text("tick", (Left + Right) / 2.0, Bottom + 38.0, "middle", iterations);
}

/** The line of a step, which begins at 1 after `before` iterations, with a dot an iteration as long
 * as these can be told apart. */
std::string line(const ResidualChart::Step& step, std::size_t before, const Axes& axes)
{
  constexpr std::size_t MaxDots = 60, MaxPoints = 1000;
  const std::size_t stride = step.residuals.size() / MaxPoints + 1;
  std::string path = 'M' + number(axes.x(static_cast<double>(before))) + ' ' + number(axes.y(1.0));
  std::string dots;
  for (std::size_t k = 0; k < step.residuals.size(); ++k)
  {
    const double residual = step.residuals[k];
    const bool isLast = k + 1 == step.residuals.size();
    if (!std::isfinite(residual) || (k % stride != 0 && !isLast))
    {
      continue;
    }
    const std::string x = number(axes.x(static_cast<double>(before + k + 1)));
    // The axis has no place for 0: that is at its end.
    const std::string y = number(residual > 0.0 ? axes.y(residual) : Bottom);
    path += 'L' + x + ' ' + y;
    if (axes.iterations <= MaxDots)
    {
      dots += "<circle class=\"dot\" cx=\"" + x + "\" cy=\"" + y + "\" r=\"3.5\"><title>" +
              count(static_cast<std::int64_t>(before + k + 1)) + ": " + number(residual) +
              "</title></circle>";
    }
  }
  return "<path class=\"line\" d=\"" + path + "\"/>" + dots;
}

} // namespace

std::string figure(const ResidualChart& chart)
{
  const Axes axes = axesOf(chart);
  std::string out = "<figure><svg role=\"img\" viewBox=\"0 0 " + number(FigureWidth) + ' ' +
                    number(Height) + "\"><title>Relative residual by " + escape(chart.iterations) +
                    "</title>" + grid(axes, chart.iterations);
  if (chart.tolerance > 0.0)
  {
    const double y = axes.y(chart.tolerance);
    out += "<path class=\"limit\" d=\"M" + number(Left) + ' ' + number(y) + 'H' + number(Right) +
           "\"/>" +
           text("limit-text", Left + 6.0, y - 5.0, "start", "tolerance " + number(chart.tolerance));
  }
  std::size_t before = 0;
  for (const ResidualChart::Step& step : chart.steps)
  {
    const double begin = axes.x(static_cast<double>(before));
    const double end = axes.x(static_cast<double>(before + step.residuals.size()));
    if (before > 0)
    {
      out += "<path class=\"grid\" d=\"M" + number(begin) + ' ' + number(Top) + 'V' +
             number(Bottom) + "\"/>";
    }
    // About seven units a letter; a name that is wider than its step would run into the next one.
    if (static_cast<double>(step.name.size()) * 7.0 < end - begin)
    {
      out += text("minor", (begin + end) / 2.0, Top - 5.0, "middle", step.name);
    }
    out += line(step, before, axes);
    before += step.residuals.size();
  }
  return out + "</svg><figcaption>" + escape(chart.caption) + "</figcaption></figure>\n";
}

} // namespace html
