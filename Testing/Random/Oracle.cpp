// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Random/Oracle.h"

#include "Testing/Random/Evaluation.h"

#include <Eigen/Dense>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace smg::testing
{
namespace
{

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using nlohmann::json;

Matrix3d tensorOf(const VectorXd& k)
{
  if (k.size() == 1)
  {
    return k[0] * Matrix3d::Identity();
  }
  Matrix3d tensor = k.head(3).asDiagonal();
  if (k.size() == 6)
  {
    tensor(0, 1) = tensor(1, 0) = k[3];
    tensor(1, 2) = tensor(2, 1) = k[4];
    tensor(0, 2) = tensor(2, 0) = k[5];
  }
  return tensor;
}

/** The equations before Dirichlet values. */
class Equations
{
public:
  Equations(const Case& given, Oracle& to)
    : On(given)
    , To(to)
    , At(given)
    , Columns(given.problem.value("columns", 1))
    , Mass(VectorXd::Zero(given.vertices()))
    , Reaction(VectorXd::Zero(given.vertices()))
    , Part(static_cast<std::size_t>(given.vertices()))
  {
    to.matrix = MatrixXd::Zero(given.vertices(), given.vertices());
    to.rightSide = to.loads = MatrixXd::Zero(given.vertices(), this->Columns);
    std::iota(this->Part.begin(), this->Part.end(), std::int64_t(0));
    this->addCells();
    to.mass = this->Mass;
    this->addDensities();
    this->addSoft();
    this->tieSides();
    this->addContacts();
    this->addFacets();
    this->To.matrix.diagonal() += this->Reaction;
  }

  void solve();
  bool isEmpty() const { return this->Empty; }

private:
  void addCells();
  void addUniformEdges();
  void addDensities();
  void addSoft();
  void addFacets();
  void tieSides();
  void addContacts();
  void applyTies();
  /** The facets of a group, and the mean of their corners. */
  std::vector<std::pair<std::size_t, Vector3d>> facetsOf(const json& place);
  double areaOf(std::size_t facet) const;
  std::int64_t nearestCorner(std::size_t facet, const Vector3d& point) const;
  MatrixXd initial();
  void prescribeMean(const std::vector<std::int64_t>& members, const MatrixXd& start,
    MatrixXd& system, MatrixXd& rightSide) const;
  std::int64_t partOf(std::int64_t v)
  {
    auto& part = this->Part[static_cast<std::size_t>(v)];
    return part == v ? v : part = this->partOf(part);
  }
  void addLoad(std::int64_t v, const Eigen::RowVectorXd& load)
  {
    this->To.rightSide.row(v) += load;
    this->To.loads.row(v) += load.cwiseAbs();
  }
  bool isGiven(const char* key) const { return this->On.problem.contains(key); }
  std::vector<json> entries(const char* key) const { return entriesOf(this->On.problem.at(key)); }

  const Case& On;
  Oracle& To;
  Evaluation At;
  int Columns;
  VectorXd Mass, Reaction;
  std::vector<std::int64_t> Part; ///< connected by cells: the parents of a forest
  /** Vertices that are one with another, and what they have more. */
  struct Tie
  {
    std::int64_t vertex, to;
    Eigen::RowVectorXd jump;
  };
  std::vector<Tie> Ties;
  std::set<std::size_t> Sides; ///< facets that are no boundary any more
  bool Empty = false;
};

void Equations::addCells()
{
  const int size = cornersOf(this->On.type);
  const bool isUniform = this->On.problem.value("weights", "cotangent") == "uniform";
  const std::vector<json> conductivity =
    this->isGiven("conductivity") ? this->entries("conductivity") : std::vector<json>{};
  const std::vector<int> entry = this->At.last(conductivity, Of::Cells, this->Empty);
  const CaseColumn* field =
    this->isGiven("field") ? find(this->On.cellColumns, this->On.problem.at("field")) : nullptr;
  this->To.conductivity.resize(static_cast<std::size_t>(this->On.cells()));
  for (std::int64_t c = 0; c < this->On.cells(); ++c)
  {
    const auto index = static_cast<std::size_t>(c);
    if (this->At.flags()[index] != 0)
    {
      continue;
    }
    const std::int64_t* corner = this->On.cell(c);
    for (int k = 1; k < size; ++k)
    {
      this->Part[static_cast<std::size_t>(this->partOf(corner[k]))] = this->partOf(corner[0]);
    }
    const MatrixXd& gradients = this->To.shapes.gradients[index];
    const double measure = this->To.shapes.measure[c];
    const Matrix3d k = !conductivity.empty() && entry[index] >= 0
                         ? tensorOf(this->At.inCell(
                             conductivity[static_cast<std::size_t>(entry[index])].at("value"), c))
                         : Matrix3d::Identity();
    this->To.conductivity[index] = k;
    const MatrixXd element = measure * gradients * k * gradients.transpose();
    for (int i = 0; i < size; ++i)
    {
      this->Mass[corner[i]] += measure / size;
      for (int j = 0; j < size && !isUniform; ++j)
      {
        this->To.matrix(corner[i], corner[j]) += element(i, j);
      }
      for (int column = 0; field && column < this->Columns; ++column)
      {
        const double* q = field->values.data() + c * field->components;
        q += field->components == 3 ? 0 : 3 * column;
        this->To.rightSide(corner[i], column) += measure * gradients.row(i).dot(Vector3d::Map(q));
      }
    }
  }
  if (isUniform)
  {
    this->addUniformEdges();
  }
}

void Equations::addUniformEdges()
{
  std::set<std::pair<std::int64_t, std::int64_t>> edges;
  const int size = cornersOf(this->On.type);
  for (std::int64_t c = 0; c < this->On.cells(); ++c)
  {
    for (int i = 0; i < size && this->At.flags()[static_cast<std::size_t>(c)] == 0; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        edges.insert(std::minmax(this->On.cell(c)[i], this->On.cell(c)[j]));
      }
    }
  }
  for (const auto& [i, j] : edges)
  {
    this->To.matrix(i, j) -= 1.0;
    this->To.matrix(j, i) -= 1.0;
    this->To.matrix(i, i) += 1.0;
    this->To.matrix(j, j) += 1.0;
  }
}

/** Screening and source, at vertices or in cells, lumped. */
void Equations::addDensities()
{
  const int size = cornersOf(this->On.type);
  for (const char* key : { "screening", "source" })
  {
    if (!this->isGiven(key))
    {
      continue;
    }
    const bool isSource = key == std::string("source");
    const std::vector<json> entries = this->entries(key);
    const auto add = [&](std::int64_t v, double mass, const VectorXd& value)
    {
      if (isSource)
      {
        this->addLoad(v, mass * value.transpose());
      }
      else
      {
        this->Reaction[v] += mass * value[0];
      }
    };
    const bool inCells =
      std::ranges::any_of(entries, [&](const json& entry) { return this->At.namesCells(entry); });
    const std::vector<int> last =
      this->At.last(entries, inCells ? Of::Cells : Of::Vertices, this->Empty);
    for (std::size_t k = 0; k < last.size(); ++k)
    {
      if (last[k] < 0)
      {
        continue;
      }
      const auto number = static_cast<std::int64_t>(k);
      const json& value = entries[static_cast<std::size_t>(last[k])].at("value");
      if (!inCells)
      {
        add(number, this->Mass[number], this->At.atVertex(value, number));
        continue;
      }
      for (int i = 0; i < size; ++i)
      {
        add(this->On.cell(number)[i], this->To.shapes.measure[number] / size,
          this->At.inCell(value, number));
      }
    }
  }
}

void Equations::addSoft()
{
  if (!this->isGiven("soft"))
  {
    return;
  }
  for (const json& soft : this->On.problem.at("soft"))
  {
    const std::vector<bool> selected = this->At.select(soft, Of::Vertices, this->Empty);
    const std::vector<json> weights = entriesOf(soft.at("weight"));
    const std::vector<int> last = this->At.last(weights, Of::Vertices, this->Empty);
    for (std::size_t v = 0; v < selected.size(); ++v)
    {
      if (selected[v] && last[v] >= 0)
      {
        const auto number = static_cast<std::int64_t>(v);
        const double weight =
          this->Mass[number] *
          this->At.atVertex(weights[static_cast<std::size_t>(last[v])].at("value"), number)[0];
        this->Reaction[number] += weight;
        this->addLoad(number, weight * this->At.atVertex(soft.at("value"), number).transpose());
      }
    }
  }
}

std::vector<std::pair<std::size_t, Vector3d>> Equations::facetsOf(const json& place)
{
  std::vector<std::pair<std::size_t, Vector3d>> facets;
  const std::vector<bool> selected = this->At.select(place, Of::Facets, this->Empty);
  for (std::size_t f = 0; f < selected.size(); ++f)
  {
    if (selected[f])
    {
      Vector3d sum = Vector3d::Zero();
      for (const std::int64_t v : this->At.facets()[f].corners)
      {
        sum += this->At.point(v);
      }
      facets.emplace_back(f, sum / static_cast<double>(this->At.facets()[f].corners.size()));
    }
  }
  return facets;
}

std::int64_t Equations::nearestCorner(std::size_t facet, const Vector3d& point) const
{
  return *std::ranges::min_element(this->At.facets()[facet].corners, {},
    [&](std::int64_t v) { return (this->At.point(v) - point).norm(); });
}

/** Each vertex of the second side is one with that of the first side which the mean shift moves to
 * its place. */
void Equations::tieSides()
{
  for (const json& entry : this->On.problem.value("periodic", json::array()))
  {
    const auto from = this->facetsOf({ { "group", entry.at("sides")[0] } });
    const auto to = this->facetsOf({ { "group", entry.at("sides")[1] } });
    Vector3d shift = Vector3d::Zero();
    for (std::size_t k = 0; k < std::min(from.size(), to.size()); ++k)
    {
      shift += (to[k].second - from[k].second) / static_cast<double>(from.size());
    }
    Eigen::RowVectorXd jump = Eigen::RowVectorXd::Zero(this->Columns);
    for (int k = 0; entry.contains("jump") && k < this->Columns; ++k)
    {
      jump[k] = entry.at("jump")[static_cast<std::size_t>(k)];
    }
    std::set<std::int64_t> tied;
    for (const auto& [facet, centre] : to)
    {
      const Vector3d place = centre - shift;
      const auto copy = std::ranges::min_element(
        from, {}, [&](const auto& other) { return (other.second - place).norm(); });
      for (const std::int64_t v : this->At.facets()[facet].corners)
      {
        if (copy != from.end() && tied.insert(v).second)
        {
          this->Ties.push_back(
            { v, this->nearestCorner(copy->first, this->At.point(v) - shift), jump });
          this->Part[static_cast<std::size_t>(this->partOf(v))] =
            this->partOf(this->Ties.back().to);
        }
      }
    }
    for (const auto& [facet, centre] : from)
    {
      this->Sides.insert(facet);
    }
    for (const auto& [facet, centre] : to)
    {
      this->Sides.insert(facet);
    }
  }
}

/** A facet and its copy: coefficient * area, shared by the corners, between each and its copy. */
void Equations::addContacts()
{
  for (const json& entry : this->On.problem.value("interface", json::array()))
  {
    const auto facets = this->facetsOf(entry);
    for (const auto& [facet, centre] : facets)
    {
      const Vector3d place = centre;
      const std::size_t own = facet;
      const auto copy = std::ranges::min_element(facets, {},
        [&](const auto& other)
        { return other.first == own ? 1e300 : (other.second - place).norm(); });
      const std::vector<std::int64_t>& corners = this->At.facets()[facet].corners;
      for (const std::int64_t v : corners)
      {
        const std::int64_t w = this->nearestCorner(copy->first, this->At.point(v));
        // Half of it, since the copy finds this facet, too.
        const double conductance = entry.at("coefficient").get<double>() * this->areaOf(facet) /
                                   (2.0 * static_cast<double>(corners.size()));
        this->To.matrix(v, v) += conductance;
        this->To.matrix(w, w) += conductance;
        this->To.matrix(v, w) -= conductance;
        this->To.matrix(w, v) -= conductance;
        this->Part[static_cast<std::size_t>(this->partOf(v))] = this->partOf(w);
      }
    }
  }
}

/** The equations of vertices that are one are added up. */
void Equations::applyTies()
{
  for (const Tie& tie : this->Ties)
  {
    this->To.matrix.row(tie.to) += this->To.matrix.row(tie.vertex).eval();
    this->To.rightSide.row(tie.to) += this->To.rightSide.row(tie.vertex).eval();
    this->To.loads.row(tie.to) += this->To.loads.row(tie.vertex).eval();
    this->To.matrix.row(tie.vertex).setZero();
    this->To.matrix(tie.vertex, tie.vertex) = 1.0;
    this->To.matrix(tie.vertex, tie.to) = -1.0;
    this->To.rightSide.row(tie.vertex) = tie.jump;
    this->To.loads.row(tie.vertex) = tie.jump.cwiseAbs();
  }
}

double Equations::areaOf(std::size_t f) const
{
  const Facet& facet = this->At.facets()[f];
  const Vector3d a = this->At.point(facet.corners[0]);
  const Vector3d b = this->At.point(facet.corners[1]) - a;
  return facet.corners.size() == 2 ? b.norm()
                                   : b.cross(this->At.point(facet.corners[2]) - a).norm() / 2;
}

void Equations::addFacets()
{
  const std::vector<json> fluxes =
    this->isGiven("flux") ? this->entries("flux") : std::vector<json>{};
  const std::vector<json> robins =
    this->isGiven("robin") ? this->entries("robin") : std::vector<json>{};
  const std::vector<int> flux = this->At.last(fluxes, Of::Facets, this->Empty);
  const std::vector<int> robin = this->At.last(robins, Of::Facets, this->Empty);
  std::vector<std::vector<json>> coefficients;
  std::vector<std::vector<int>> coefficient;
  for (const json& entry : robins)
  {
    coefficients.push_back(entriesOf(entry.at("coefficient")));
    coefficient.push_back(this->At.last(coefficients.back(), Of::Facets, this->Empty));
  }
  const auto add = [&](std::size_t f, int fluxOf, int robinOf)
  {
    const Facet& facet = this->At.facets()[f];
    const double share = this->areaOf(f) / static_cast<double>(facet.corners.size());
    for (const std::int64_t v : facet.corners)
    {
      if (fluxOf >= 0)
      {
        const json& value = fluxes[static_cast<std::size_t>(fluxOf)].at("value");
        this->addLoad(v, share * this->At.atCorner(value, facet.cell, v).transpose());
      }
      if (robinOf < 0)
      {
        continue;
      }
      const auto r = static_cast<std::size_t>(robinOf);
      if (const int entry = coefficient[r][f]; entry >= 0)
      {
        const json& value = coefficients[r][static_cast<std::size_t>(entry)].at("value");
        const double weight = share * this->At.atCorner(value, facet.cell, v)[0];
        this->Reaction[v] += weight;
        this->addLoad(
          v, weight * this->At.atCorner(robins[r].at("ambient"), facet.cell, v).transpose());
      }
    }
  };
  const auto entryOf = [](const std::vector<int>& entries, std::size_t f)
  { return entries.empty() ? -1 : entries[f]; };
  for (const std::size_t f : this->At.boundary())
  {
    if (!this->Sides.contains(f))
    {
      add(f, entryOf(flux, f), entryOf(robin, f));
    }
  }
  const std::vector<int> fluxInside = this->At.lastInside(fluxes);
  const std::vector<int> robinInside = this->At.lastInside(robins);
  for (const std::size_t f : this->At.inner())
  {
    add(f, fluxInside[f], robinInside[f]);
  }
}

MatrixXd Equations::initial()
{
  MatrixXd initial = MatrixXd::Zero(this->On.vertices(), this->Columns);
  std::vector<json> entries;
  if (this->isGiven("initial"))
  {
    entries = this->entries("initial");
  }
  else if (this->isGiven("dirichlet") &&
           std::ranges::any_of(this->entries("dirichlet"),
             [](const json& entry) { return entry.at("value") == "position"; }))
  {
    entries = { json{ { "value", "position" } } };
  }
  const std::vector<int> last = this->At.last(entries, Of::Vertices, this->Empty);
  for (std::size_t v = 0; v < last.size(); ++v)
  {
    if (last[v] >= 0)
    {
      const auto number = static_cast<std::int64_t>(v);
      initial.row(number) =
        this->At.atVertex(entries[static_cast<std::size_t>(last[v])].at("value"), number)
          .transpose();
    }
  }
  return initial;
}

/** Instead of the equation of the first of these vertices, which follows from the others. */
void Equations::prescribeMean(const std::vector<std::int64_t>& members, const MatrixXd& start,
  MatrixXd& system, MatrixXd& rightSide) const
{
  const double scale = system.diagonal().cwiseAbs().maxCoeff();
  double mass = 0.0;
  for (const std::int64_t v : members)
  {
    mass += this->Mass[v];
  }
  system.row(members[0]).setZero();
  rightSide.row(members[0]).setZero();
  for (const std::int64_t v : members)
  {
    system(members[0], v) = scale * this->Mass[v] / mass;
    rightSide.row(members[0]) += scale * this->Mass[v] / mass * start.row(v);
  }
}

void Equations::solve()
{
  const std::int64_t vertices = this->On.vertices();
  const MatrixXd start = this->initial();
  const std::vector<json> dirichlet =
    this->isGiven("dirichlet") ? this->entries("dirichlet") : std::vector<json>{};
  std::vector<int> held = this->At.last(dirichlet, Of::Vertices, this->Empty);
  held.resize(static_cast<std::size_t>(vertices), -1);
  std::map<std::int64_t, std::vector<std::int64_t>> parts;
  std::set<std::int64_t> fixed;
  for (std::int64_t v = 0; v < vertices; ++v)
  {
    const std::int64_t part = this->partOf(v);
    parts[part].push_back(v);
    if (held[static_cast<std::size_t>(v)] >= 0 || this->Reaction[v] > 0.0)
    {
      fixed.insert(part);
    }
  }
  this->To.determined.assign(static_cast<std::size_t>(vertices), true);
  MatrixXd system = this->To.matrix;
  // A body without any condition: compatible loads, and one equation for its mean.
  for (const auto& [part, members] : parts)
  {
    double mass = 0.0;
    VectorXd load = VectorXd::Zero(this->Columns);
    for (const std::int64_t v : members)
    {
      mass += this->Mass[v];
      load += this->To.rightSide.row(v).transpose();
    }
    if (fixed.contains(part))
    {
      continue;
    }
    if (mass == 0.0)
    {
      for (const std::int64_t v : members)
      {
        this->To.determined[static_cast<std::size_t>(v)] = false;
        system.row(v).setZero();
        system(v, v) = 1.0;
        this->To.rightSide.row(v).setZero();
      }
      continue;
    }
    for (const std::int64_t v : members)
    {
      this->To.rightSide.row(v) -= this->Mass[v] / mass * load.transpose();
    }
  }
  this->To.matrix = system;
  this->applyTies();
  for (std::int64_t v = 0; v < vertices; ++v)
  {
    if (const int entry = held[static_cast<std::size_t>(v)]; entry >= 0)
    {
      this->To.matrix.row(v).setZero();
      this->To.matrix(v, v) = 1.0;
      this->To.rightSide.row(v) =
        this->At.atVertex(dirichlet[static_cast<std::size_t>(entry)].at("value"), v).transpose();
    }
  }
  system = this->To.matrix;
  MatrixXd rightSide = this->To.rightSide;
  for (const auto& [part, members] : parts)
  {
    if (!fixed.contains(part) && this->To.determined[static_cast<std::size_t>(members[0])])
    {
      this->prescribeMean(members, start, system, rightSide);
    }
  }
  const Eigen::PartialPivLU<MatrixXd> factor(system);
  this->To.solution = factor.solve(rightSide);
  this->To.solution += factor.solve(rightSide - system * this->To.solution);
}

} // namespace

Oracle::Oracle(const Case& given)
  : shapes(given)
{
  Equations equations(given, *this);
  equations.solve();
  this->refusal = equations.isEmpty() ? "an entry selects nothing" : "";
}

} // namespace smg::testing
