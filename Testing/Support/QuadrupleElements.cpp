// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/QuadrupleElements.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

__extension__ using Quad = __float128;
using QuadVector = std::array<Quad, 3>;

Quad dot(const QuadVector& a, const QuadVector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

QuadVector cross(const QuadVector& a, const QuadVector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Quad root(Quad square)
{
  Quad value = std::sqrt(static_cast<double>(square));
  for (int n = 0; n < 3; ++n)
  {
    value = (value + square / value) / 2;
  }
  return value;
}

/** A cell: its measure and the gradients of the hat functions of its corners. */
struct QuadCell
{
  Quad measure;
  std::vector<QuadVector> gradient;
};

QuadCell cellOf(const StreamMesh& mesh, std::int64_t cell)
{
  const int count = cornersOf(mesh.cellType);
  std::vector<QuadVector> p(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
  {
    const double* point = &mesh.positions[3 * mesh.corners[cell * count + k]];
    p[k] = { point[0], point[1], point[2] };
  }
  const auto minus = [](const QuadVector& a, const QuadVector& b) {
    return QuadVector{ a[0] - b[0], a[1] - b[1], a[2] - b[2] };
  };
  QuadCell result{ 0, std::vector<QuadVector>(p.size()) };
  const QuadVector normal = cross(minus(p[1], p[0]), minus(p[2], p[0]));
  for (int k = 0; k < count; ++k)
  {
    // Perpendicular to the opposite facet; its value at the corner less that at the facet is 1.
    const QuadVector a = p[(k + 1) % count], edge = minus(p[(k + 2) % count], a);
    const QuadVector n =
      count == 3 ? cross(normal, edge) : cross(edge, minus(p[(k + 3) % count], a));
    const Quad height = dot(n, minus(p[k], a));
    result.gradient[k] = { n[0] / height, n[1] / height, n[2] / height };
    result.measure = height / 6;
  }
  result.measure = count == 3                 ? root(dot(normal, normal)) / 2
                   : result.measure < Quad(0) ? -result.measure
                                              : result.measure;
  return result;
}

/** The numbers of ExactResults, before they are rounded. */
struct Totals
{
  Quad energy = 0;
  std::map<std::string, Quad> flux;
  std::map<std::string, std::array<QuadVector, 2>> parts;
};

ExactResults rounded(const Totals& totals)
{
  ExactResults results;
  results.energy = static_cast<double>(totals.energy);
  for (const auto& [name, flux] : totals.flux)
  {
    results.flux[name] = static_cast<double>(flux);
  }
  for (const auto& [name, means] : totals.parts)
  {
    for (std::size_t kind = 0; kind < 2; ++kind)
    {
      for (std::size_t d = 0; d < 3; ++d)
      {
        results.parts[name][kind][static_cast<Eigen::Index>(d)] =
          static_cast<double>(means[kind][d]);
      }
    }
  }
  return results;
}

using QuadMatrix = std::vector<std::vector<Quad>>;

/** Solves A u = y, A symmetric and positive definite, by LDL^T: A becomes the factor. The order of
 * a stream keeps the band narrow. */
std::vector<Quad> solveFactored(QuadMatrix A, std::vector<Quad> y)
{
  const std::size_t n = y.size();
  std::vector<std::size_t> begin(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    begin[i] = static_cast<std::size_t>(
      std::ranges::find_if(A[i], [](Quad value) { return value != Quad(0); }) - A[i].begin());
    for (std::size_t j = begin[i]; j < i; ++j)
    {
      for (std::size_t k = std::max(begin[i], begin[j]); k < j; ++k)
      {
        A[i][j] -= A[i][k] * A[j][k] * A[k][k];
      }
      A[i][j] /= A[j][j];
    }
    for (std::size_t k = begin[i]; k < i; ++k)
    {
      A[i][i] -= A[i][k] * A[i][k] * A[k][k];
      y[i] -= A[i][k] * y[k];
    }
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    y[i] /= A[i][i];
  }
  for (std::size_t i = n; i-- > 0;)
  {
    for (std::size_t k = begin[i]; k < i; ++k)
    {
      y[k] -= A[i][k] * y[i];
    }
  }
  return y;
}

/** The equations of a problem. */
class QuadElements
{
public:
  explicit QuadElements(const ElementProblem& problem)
    : Given(problem)
    , Mesh(problem.mesh())
    , Count(cornersOf(this->Mesh.cellType))
    , A(static_cast<std::size_t>(this->Mesh.vertices()),
        std::vector<Quad>(static_cast<std::size_t>(this->Mesh.vertices()), 0))
    , B(A.size(), 0)
  {
    this->addCells();
    this->addExchanges();
    this->solve();
  }

  Totals totals() const
  {
    Totals totals;
    this->addFluxes(totals);
    this->addMeans(totals);
    return totals;
  }

private:
  /** What a Robin condition exchanges at a vertex. */
  struct Exchange
  {
    std::string name;
    std::int64_t vertex;
    Quad factor, ambient;
  };

  Quad conductivity(std::int64_t cell) const
  {
    return this->Given.Conductivity(this->Given.centroid(cell))(0, 0);
  }

  void addCells()
  {
    for (std::int64_t c = 0; c < this->Mesh.cells(); ++c)
    {
      const QuadCell& cell = this->Cells.emplace_back(cellOf(this->Mesh, c));
      const std::int64_t* corner = &this->Mesh.corners[c * this->Count];
      for (int i = 0; i < this->Count; ++i)
      {
        std::vector<std::int64_t> facet;
        for (int j = 0; j < this->Count; ++j)
        {
          this->A[corner[i]][corner[j]] +=
            this->conductivity(c) * cell.measure * dot(cell.gradient[i], cell.gradient[j]);
          i == j ? void() : facet.push_back(corner[j]);
        }
        std::ranges::sort(facet);
        ++this->Facets[facet];
      }
    }
  }

  void addExchanges()
  {
    for (const auto& [facet, uses] : this->Facets)
    {
      const int robin =
        uses == 1 ? this->Given.conditionOf(this->Given.RobinConditions, facet) : -1;
      if (robin >= 0)
      {
        this->addExchange(facet, robin);
      }
    }
  }

  void addExchange(const std::vector<std::int64_t>& facet, int robin)
  {
    const auto edge = [&](std::size_t a)
    {
      const ElementProblem::Point from = this->Given.vertex(facet[0]);
      const ElementProblem::Point to = this->Given.vertex(facet[a]);
      return QuadVector{ Quad(to[0]) - from[0], Quad(to[1]) - from[1], Quad(to[2]) - from[2] };
    };
    const QuadVector normal = this->Count == 3 ? edge(1) : cross(edge(1), edge(2));
    const Quad share = root(dot(normal, normal)) / (this->Count == 3 ? 2 : 6);
    const auto& condition = this->Given.RobinConditions[static_cast<std::size_t>(robin)];
    for (const std::int64_t v : facet)
    {
      const Quad factor = share * Quad(condition.coefficient(this->Given.vertex(v)));
      const Quad ambient = condition.ambient(this->Given.vertex(v))[0];
      this->A[v][v] += factor;
      this->B[v] += factor * ambient;
      this->Exchanges.push_back({ "robin[" + std::to_string(robin) + ']', v, factor, ambient });
    }
  }

  /** Prescribed rows become those of the identity; the others keep a symmetric matrix. */
  void solve()
  {
    const std::size_t n = this->B.size();
    QuadMatrix free = this->A;
    std::vector<Quad> y = this->B;
    std::vector<Quad> prescribed(n, 0);
    for (std::size_t v = 0; v < n; ++v)
    {
      const auto vertex = static_cast<std::int64_t>(v);
      this->Dirichlet.push_back(this->Given.dirichletOf(vertex));
      if (this->Dirichlet[v] >= 0)
      {
        prescribed[v] =
          this->Given.DirichletConditions[static_cast<std::size_t>(this->Dirichlet[v])].value(
            this->Given.vertex(vertex))[0];
      }
    }
    for (std::size_t i = 0; i < n; ++i)
    {
      for (std::size_t j = 0; j < n; ++j)
      {
        y[i] -= this->A[i][j] * prescribed[j];
        const bool areFree = this->Dirichlet[i] < 0 && this->Dirichlet[j] < 0;
        free[i][j] = areFree ? this->A[i][j] : Quad(i == j ? 1 : 0);
      }
      y[i] = this->Dirichlet[i] < 0 ? y[i] : prescribed[i];
    }
    this->U = solveFactored(std::move(free), std::move(y));
  }

  void addFluxes(Totals& totals) const
  {
    for (std::size_t i = 0; i < this->U.size(); ++i)
    {
      Quad reaction = -this->B[i];
      for (std::size_t j = 0; j < this->U.size(); ++j)
      {
        reaction += this->A[i][j] * this->U[j];
      }
      if (this->Dirichlet[i] >= 0)
      {
        totals.flux["dirichlet[" + std::to_string(this->Dirichlet[i]) + ']'] += reaction;
      }
    }
    for (const Exchange& exchange : this->Exchanges)
    {
      totals.flux[exchange.name] +=
        exchange.factor * (exchange.ambient - this->U[static_cast<std::size_t>(exchange.vertex)]);
    }
  }

  void addMeans(Totals& totals) const
  {
    std::map<std::string, Quad> measures;
    for (std::int64_t c = 0; c < this->Mesh.cells(); ++c)
    {
      const QuadCell& cell = this->Cells[static_cast<std::size_t>(c)];
      QuadVector gradient{};
      for (int i = 0; i < this->Count; ++i)
      {
        for (int d = 0; d < 3; ++d)
        {
          gradient[d] += this->U[this->Mesh.corners[c * this->Count + i]] * cell.gradient[i][d];
        }
      }
      totals.energy += this->conductivity(c) * cell.measure * dot(gradient, gradient) / 2;
      const int part = this->Given.Part(this->Given.centroid(c));
      for (const std::string& name :
        { "conductivity[" + std::to_string(part) + ']', std::string("all") })
      {
        measures[name] += cell.measure;
        for (int d = 0; d < 3; ++d)
        {
          totals.parts[name][0][d] += cell.measure * gradient[d];
          totals.parts[name][1][d] -= this->conductivity(c) * cell.measure * gradient[d];
        }
      }
    }
    for (auto& [name, means] : totals.parts)
    {
      for (QuadVector& mean : means)
      {
        std::ranges::for_each(mean, [&](Quad& number) { number /= measures[name]; });
      }
    }
  }

  const ElementProblem& Given;
  const StreamMesh& Mesh;
  int Count;
  QuadMatrix A;
  std::vector<Quad> B, U;
  std::vector<QuadCell> Cells;
  std::map<std::vector<std::int64_t>, int> Facets; ///< how many cells each has
  std::vector<Exchange> Exchanges;
  std::vector<int> Dirichlet;
};

} // namespace

ExactResults solveInQuadruple(const ElementProblem& problem)
{
  return rounded(QuadElements(problem).totals());
}

} // namespace smg::testing
