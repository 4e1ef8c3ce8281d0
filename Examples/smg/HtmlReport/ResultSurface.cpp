// SPDX-License-Identifier: BSD-3-Clause
#include "HtmlReport/ResultSurface.h"

#include "HtmlReport/ShownColumns.h"

#include "IO/Files/Base64.h"
#include "IO/Preview/StreamPreview.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

namespace html
{

namespace
{

constexpr std::uint16_t Missing = std::numeric_limits<std::uint16_t>::max();

template <class T>
std::string base64(const std::vector<T>& values)
{
  std::string text;
  smg::Base64Encoder encoder;
  encoder.append(std::as_bytes(std::span(values)), text);
  encoder.finish(text);
  return text;
}

void append(std::uint16_t value, std::vector<std::byte>& bytes)
{
  // Typed arrays of browsers are little-endian on every machine that has one.
  bytes.push_back(static_cast<std::byte>(value & 0xFF));
  bytes.push_back(static_cast<std::byte>(value >> 8));
}

ResultSurface::Shown colours(const smg::Column& column)
{
  ResultSurface::Shown shown{ column.spec.name, true };
  const bool isBytes = column.spec.type == smg::ScalarType::UInt8;
  for (std::size_t v = 0; v < column.tuples(); ++v)
  {
    for (int k = 0; k < 3; ++k)
    {
      const double value = column.value(v, k) * (isBytes ? 1.0 : 255.0);
      shown.values.push_back(static_cast<std::byte>(
        static_cast<int>(std::isfinite(value) ? std::clamp(value + 0.5, 0.0, 255.0) : 0.0)));
    }
  }
  return shown;
}

ResultSurface::Shown numbers(const smg::Column& column, int component, const ValueRange& range)
{
  const bool isOne = column.spec.components == 1;
  ResultSurface::Shown shown{ column.spec.name +
                              (isOne ? "" : '[' + std::to_string(component) + ']') };
  if (!range.isEmpty())
  {
    shown.least = range.least;
    shown.most = range.most;
  }
  const double extent = shown.most - shown.least;
  for (std::size_t v = 0; v < column.tuples(); ++v)
  {
    const double value = column.value(v, component);
    const double share = extent > 0.0 ? (value - shown.least) / extent : 0.0;
    append(std::isfinite(value) && std::isfinite(share)
             ? static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * (Missing - 1)))
             : Missing,
      shown.values);
  }
  return shown;
}

void takePoints(const smg::MeshPiece& piece, ResultSurface& surface)
{
  std::array<double, 6>& bounds = surface.bounds;
  for (std::size_t k = 0; k < 3; ++k)
  {
    bounds[2 * k] = std::numeric_limits<double>::infinity();
    bounds[2 * k + 1] = -bounds[2 * k];
    for (std::size_t i = k; i < piece.positions.size(); i += 3)
    {
      bounds[2 * k] = std::min(bounds[2 * k], piece.positions[i]);
      bounds[2 * k + 1] = std::max(bounds[2 * k + 1], piece.positions[i]);
    }
  }
  // The centre is subtracted in double precision: scans in map coordinates are far from 0.
  for (std::size_t i = 0; i < piece.positions.size(); ++i)
  {
    const std::size_t k = i % 3;
    const double centre = bounds[2 * k] + 0.5 * (bounds[2 * k + 1] - bounds[2 * k]);
    surface.positions.push_back(static_cast<float>(piece.positions[i] - centre));
  }
  surface.corners.assign(piece.corners.begin(), piece.corners.end());
}

} // namespace

ResultSurface resultSurface(smg::MeshSource& mesh, const std::vector<std::string>& first,
  std::int64_t memory, const smg::ProgressFunction& progress)
{
  constexpr std::int64_t OfPoint = 3500, FewestPoints = 1000;
  ResultSurface surface;
  ShownColumns source(mesh, first);
  const smg::MeshPiece piece = smg::makePreview(
    source, std::clamp(memory / OfPoint, FewestPoints, SurfacePoints), progress, memory);
  surface.vertices = mesh.info().vertices;
  surface.isSolid = mesh.info().cellType == smg::CellType::Tetrahedron;
  if (piece.corners.empty() || piece.vertices() > Missing)
  {
    surface.failure = "its cells repeat a corner or one another.";
    return surface;
  }
  takePoints(piece, surface);
  for (std::size_t c = 0; c < piece.vertexColumns.size(); ++c)
  {
    const smg::Column& column = piece.vertexColumns[c];
    if (ShownColumns::isColour(column.spec))
    {
      surface.columns.push_back(colours(column));
      continue;
    }
    for (int k = 0; k < column.spec.components; ++k)
    {
      surface.columns.push_back(numbers(column, k, source.range(c, k)));
    }
  }
  // Of a mesh that has moved, only colours are as good as the surface alone.
  const auto coloured = std::ranges::find(surface.columns, true, &ResultSurface::Shown::isColour);
  if (!first.empty() && !surface.columns.empty())
  {
    surface.shown = 0;
  }
  else if (coloured != surface.columns.end())
  {
    surface.shown = static_cast<int>(coloured - surface.columns.begin());
  }
  return surface;
}

std::string ResultSurface::json() const
{
  nlohmann::ordered_json json;
  json["isSolid"] = this->isSolid;
  json["bounds"] = this->bounds;
  json["positions"] = base64(this->positions);
  json["corners"] = base64(this->corners);
  json["shown"] = this->shown;
  json["columns"] = nlohmann::ordered_json::array();
  for (const Shown& shown : this->columns)
  {
    json["columns"].push_back({ { "name", shown.name }, { "isColour", shown.isColour },
      { "least", shown.least }, { "most", shown.most }, { "values", base64(shown.values) } });
  }
  const std::string text =
    json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size() + 64);
  for (const char c : text)
  {
    out += c == '<' ? "\\u003c" : std::string(1, c);
  }
  return out;
}

} // namespace html
