// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Random/Relations.h"

#include "Testing/Random/Evaluation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace smg::testing
{
namespace
{

using nlohmann::json;

/** What a datum of a problem is measured in. */
enum class Kind
{
  Level,       ///< the unknown
  Step,        ///< a difference of the unknown
  Load,        ///< per area of a surface, volume of a solid
  Flux,        ///< per length of a boundary, area of one
  Reaction,    ///< a coefficient of the unknown, as Load
  Transfer,    ///< a coefficient of the unknown, as Flux
  Field,       ///< a vector, as Flux
  Conductivity ///< a number or a tensor
};

/** Calls visit(part) for each part of a member, if there is one. */
void visitEach(json& in, const char* key, const std::function<void(json&)>& visit)
{
  if (in.contains(key))
  {
    std::ranges::for_each(in.at(key), visit);
  }
}

/** Calls visit(value, kind) for each value of the problem. */
void visitValues(json& problem, const std::function<void(json&, Kind)>& visit)
{
  const auto datum = [&](json& in, const char* key, Kind kind)
  {
    if (!in.contains(key))
    {
      return;
    }
    json& given = in.at(key);
    if (!given.is_array() || given.empty() || !given[0].is_object())
    {
      visit(given, kind);
      return;
    }
    for (json& entry : given)
    {
      visit(entry.at("value"), kind);
    }
  };
  datum(problem, "conductivity", Kind::Conductivity);
  datum(problem, "screening", Kind::Reaction);
  datum(problem, "source", Kind::Load);
  datum(problem, "initial", Kind::Level);
  datum(problem, "field", Kind::Field);
  datum(problem, "dirichlet", Kind::Level);
  datum(problem, "flux", Kind::Flux);
  visitEach(problem, "periodic", [&](json& sides) { datum(sides, "jump", Kind::Step); });
  visitEach(
    problem, "interface", [&](json& contact) { datum(contact, "coefficient", Kind::Transfer); });
  visitEach(problem, "robin",
    [&](json& robin)
    {
      datum(robin, "coefficient", Kind::Transfer);
      datum(robin, "ambient", Kind::Level);
    });
  visitEach(problem, "soft",
    [&](json& soft)
    {
      datum(soft, "weight", Kind::Reaction);
      datum(soft, "value", Kind::Level);
    });
}

/** Calls visit(object) for each object with a place. */
void visitPlaces(json& in, const std::function<void(json&)>& visit)
{
  if (in.is_object())
  {
    visit(in);
  }
  if (in.is_structured())
  {
    for (json& part : in)
    {
      visitPlaces(part, visit);
    }
  }
}

/** The values of a row, from those that it had. */
using Change = std::function<std::vector<double>(const std::vector<double>&)>;

/** Applies a change to a value of a case: a number, a list of numbers, or columns, of which the
 * case gets copies. */
void change(Case& in, json& value, const char* suffix, const Change& apply)
{
  if (!value.is_string())
  {
    const bool isNumber = value.is_number();
    const std::vector<double> changed =
      apply(isNumber ? std::vector{ value.get<double>() } : value.get<std::vector<double>>());
    value = isNumber ? json(changed[0]) : json(changed);
    return;
  }
  const std::string name = value, other = name + suffix;
  for (std::vector<CaseColumn>* columns : { &in.vertexColumns, &in.cellColumns })
  {
    const CaseColumn* from = find(*columns, name);
    if (!from || find(*columns, other))
    {
      continue;
    }
    CaseColumn to{ other, from->components, {}, false };
    for (auto row = from->values.begin(); row != from->values.end(); row += from->components)
    {
      const std::vector<double> changed = apply({ row, row + from->components });
      to.values.insert(to.values.end(), changed.begin(), changed.end());
    }
    columns->push_back(std::move(to));
  }
  value = other;
}

/** With positions as a column, and with the initial values that they would be. */
Case explicitly(const Case& given)
{
  Case made = given;
  const json& problem = given.problem;
  const auto isPosition = [](const json& entry) { return entry.at("value") == "position"; };
  if (!problem.contains("initial") && problem.contains("dirichlet") &&
      std::ranges::any_of(entriesOf(problem.at("dirichlet")), isPosition))
  {
    made.problem["initial"] = "position";
  }
  bool isAny = false;
  visitValues(made.problem,
    [&](json& value, Kind)
    {
      isAny = isAny || value == "position";
      value = value == "position" ? json("vPosition") : value;
    });
  if (isAny)
  {
    made.vertexColumns.push_back({ "vPosition", 3, given.points, false });
  }
  return made;
}

Related linear(const Case& given)
{
  Related related{ explicitly(given), [](const Eigen::MatrixXd& x) { return x / -2.0; }, true };
  visitValues(related.other.problem,
    [&](json& value, Kind kind)
    {
      if (kind == Kind::Level || kind == Kind::Step || kind == Kind::Load || kind == Kind::Flux ||
          kind == Kind::Field)
      {
        change(related.other, value, "*-2",
          [](std::vector<double> row)
          {
            std::ranges::for_each(row, [](double& x) { x *= -2.0; });
            return row;
          });
      }
    });
  return related;
}

Related scaled(const Case& given)
{
  Related related{ explicitly(given), [](const Eigen::MatrixXd& x) { return x; } };
  const double s = std::exp2(static_cast<double>(given.seed % 21) - 10.0);
  Case& other = related.other;
  std::ranges::for_each(other.points, [s](double& x) { x *= s; });
  visitPlaces(other.problem,
    [s](json& place)
    {
      if (place.contains("halfspace"))
      {
        place["halfspace"][3] = place["halfspace"][3].get<double>() * s;
      }
      const auto scale = [s](json& x) { x = x.get<double>() * s; };
      visitEach(place, "box", scale);
      visitEach(place, "sphere", scale);
      visitEach(place, "nearest", [&](json& point) { std::ranges::for_each(point, scale); });
    });
  // The stiffness grows like s^(d - 2), that of uniform weights not at all.
  const int d = given.type == CellType::Triangle ? 2 : 3;
  const bool isUniform = given.problem.value("weights", "") == "uniform";
  const double inside = std::pow(s, isUniform ? -d : -2),
               outside = std::pow(s, isUniform ? 1 - d : -1);
  visitValues(other.problem,
    [&](json& value, Kind kind)
    {
      const bool isInside = kind == Kind::Load || kind == Kind::Reaction;
      if (isInside || kind == Kind::Flux || kind == Kind::Transfer || kind == Kind::Field)
      {
        const double factor = isInside ? inside : outside;
        change(other, value, isInside ? "*inside" : "*outside",
          [factor](std::vector<double> row)
          {
            std::ranges::for_each(row, [factor](double& x) { x *= factor; });
            return row;
          });
      }
    });
  return related;
}

std::optional<Related> shifted(const Case& given)
{
  if (given.problem.contains("screening"))
  {
    return std::nullopt;
  }
  const int columns = given.problem.value("columns", 1);
  const Eigen::RowVector3d all(3.0, -2.0, 0.5);
  const Eigen::RowVectorXd by = all.head(columns);
  Related related{ explicitly(given), [by](const Eigen::MatrixXd& x) { return x.rowwise() - by; },
    false, 3.0 };
  if (!related.other.problem.contains("initial"))
  {
    related.other.problem["initial"] = std::vector<double>(static_cast<std::size_t>(columns), 0.0);
  }
  visitValues(related.other.problem,
    [&](json& value, Kind kind)
    {
      if (kind == Kind::Level)
      {
        change(related.other, value, "+1",
          [by](std::vector<double> row)
          {
            for (std::size_t k = 0; k < row.size(); ++k)
            {
              row[k] += by[static_cast<Eigen::Index>(k)];
            }
            return row;
          });
      }
    });
  return related;
}

std::optional<Related> permuted(const Case& given)
{
  if (std::ranges::any_of(given.flags(), [](std::uint8_t flag) { return flag & DuplicateCell; }))
  {
    return std::nullopt; // which of two cells counts depends on their order
  }
  Random random(given.seed + 1);
  std::vector<std::int64_t> order(static_cast<std::size_t>(given.cells()));
  std::iota(order.begin(), order.end(), std::int64_t(0));
  for (std::int64_t c = given.cells() - 1; c > 0; --c)
  {
    std::swap(
      order[static_cast<std::size_t>(c)], order[static_cast<std::size_t>(random.below(c + 1))]);
  }
  Case other = given;
  const int size = cornersOf(given.type);
  std::vector<double> numbers(static_cast<std::size_t>(given.vertices()));
  std::iota(numbers.begin(), numbers.end(), 0.0);
  other.vertexColumns.push_back({ "number", 1, numbers, false });
  for (std::size_t c = 0; c < order.size(); ++c)
  {
    const std::int64_t turn = random.below(size);
    for (int k = 0; k < size; ++k)
    {
      other.corners[c * size + k] = given.cell(order[c])[(k + turn) % size];
    }
    for (std::size_t column = 0; column < given.cellColumns.size(); ++column)
    {
      const CaseColumn& from = given.cellColumns[column];
      std::copy_n(from.values.begin() + order[c] * from.components, from.components,
        other.cellColumns[column].values.begin() +
          static_cast<std::ptrdiff_t>(c) * from.components);
      if (from.name == FacetGroupsName)
      {
        // Facets follow the corners that they are opposite to.
        const auto to = other.cellColumns[column].values.begin() +
                        static_cast<std::ptrdiff_t>(c) * from.components;
        std::rotate(to, to + turn, to + from.components);
      }
    }
  }
  other = other.part(std::vector<std::uint8_t>(order.size(), 1));
  std::vector<std::int64_t> now(numbers.size());
  for (std::size_t v = 0; v < now.size(); ++v)
  {
    now[static_cast<std::size_t>(other.vertexColumns.back().values[v])] =
      static_cast<std::int64_t>(v);
  }
  other.vertexColumns.pop_back();
  visitPlaces(other.problem,
    [&](json& place)
    {
      visitEach(place, "vertices",
        [&](json& v)
        {
          const auto number = v.get<std::size_t>();
          v = number < now.size() ? now[number] : v.get<std::int64_t>();
        });
    });
  return Related{ other,
    [now](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return x(now, Eigen::all); } };
}

/** (x, y, z) becomes (y, z, x). */
void turn(auto xyz)
{
  std::rotate(xyz, xyz + 1, xyz + 3);
}

Related turned(const Case& given)
{
  Related related{ explicitly(given), [](const Eigen::MatrixXd& x) { return x; } };
  Case& other = related.other;
  for (auto p = other.points.begin(); p != other.points.end(); p += 3)
  {
    turn(p);
  }
  visitPlaces(other.problem,
    [](json& place)
    {
      for (const char* key : { "halfspace", "box", "sphere" })
      {
        if (place.contains(key))
        {
          auto numbers = place.at(key).get<std::vector<double>>();
          turn(numbers.begin());
          if (numbers.size() == 6)
          {
            turn(numbers.begin() + 3);
          }
          place[key] = numbers;
        }
      }
      visitEach(place, "nearest",
        [](json& point)
        {
          auto numbers = point.get<std::vector<double>>();
          turn(numbers.begin());
          point = numbers;
        });
    });
  visitValues(other.problem,
    [&](json& value, Kind kind)
    {
      if (kind == Kind::Field || kind == Kind::Conductivity)
      {
        // xx, yy, zz, xy, yz, xz of a tensor become yy, zz, xx, yz, xz, xy.
        change(other, value, "turned",
          [](std::vector<double> row)
          {
            for (std::size_t k = 0; k + 3 <= row.size(); k += 3)
            {
              turn(row.begin() + static_cast<std::ptrdiff_t>(k));
            }
            return row;
          });
      }
    });
  return related;
}

} // namespace

std::optional<Related> related(const Case& given, const std::string& relation)
{
  return relation == "linear"     ? linear(given)
         : relation == "scaled"   ? scaled(given)
         : relation == "shifted"  ? shifted(given)
         : relation == "permuted" ? permuted(given)
                                  : std::optional(turned(given));
}

} // namespace smg::testing
