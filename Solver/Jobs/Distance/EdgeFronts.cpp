// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/EdgeFronts.h"

#include <algorithm>
#include <cmath>

// The lower envelope of the distances of intervals on an edge. Each insertion walks along the
// intervals of the edge that the new one meets; where two meet, the border between them is a root
// of a quadratic equation, and the nearer one is found by a look between borders, so that no root
// needs to be believed.

namespace smg
{

namespace
{

/** An interval must be nearer by this share of the distance to take the place of another one. */
constexpr double Nearer = 1e-14;
/** Parts that are shorter than this share of the place where they end are left out. */
constexpr double Shortest = 1e-14;
/** Images that differ by less are one, relative to their distance. */
constexpr double SameImage = 1e-12;

bool isEmpty(double begin, double end)
{
  return !(end - begin > Shortest * end);
}

/** Whether the paths of two intervals of an edge come from one place in the same way. */
bool goesOn(const FrontInterval& a, const FrontInterval& b)
{
  const double size = std::fabs(a.image.x) + a.image.depth + a.image.offset;
  return a.from == b.from && a.source == b.source && a.image.isStraight == b.image.isStraight &&
         std::fabs(a.image.x - b.image.x) + std::fabs(a.image.depth - b.image.depth) +
             std::fabs(a.image.offset - b.image.offset) <=
           SameImage * size;
}

/** Whether a front is the nearer one of two between borders. In the middle they may only touch:
 * that is no border, and happens where one comes straight through the vertex that the other comes
 * from.
 */
bool isNearer(const FrontImage& front, const FrontImage& other, double begin, double end)
{
  for (const double share : { 0.5, 0.25, 0.75 })
  {
    const double at = begin + share * (end - begin), known = other.at(at);
    const double less = known - front.at(at), least = Nearer * std::fabs(known);
    if (std::fabs(less) > least)
    {
      return less > 0;
    }
  }
  return false;
}

} // namespace

EdgeFronts::EdgeFronts(Pool& pool, std::int64_t edges)
  : Owner(pool)
  , HeadMemory(pool, static_cast<std::size_t>(edges) * sizeof(std::uint32_t))
  , Heads(reinterpret_cast<std::uint32_t*>(this->HeadMemory.data()))
{
  std::fill_n(this->Heads, edges, None);
}

std::uint32_t EdgeFronts::create(const FrontInterval& interval, State state)
{
  std::uint32_t number = this->Free;
  if (number != None)
  {
    this->Free = this->Nodes[number].next;
  }
  else
  {
    number = static_cast<std::uint32_t>(this->Created++);
    if (this->Created * sizeof(Node) > this->Memory.size())
    {
      this->Memory.grow(this->Owner,
        std::max<std::size_t>(LeastMost, this->Created + this->Created / 4) * sizeof(Node));
      this->Nodes = reinterpret_cast<Node*>(this->Memory.data());
    }
  }
  ++this->Used;
  this->Nodes[number] = { interval, None, state };
  return number;
}

void EdgeFronts::remove(std::uint32_t number)
{
  this->Nodes[number].state = Unused;
  this->Nodes[number].next = this->Free;
  this->Free = number;
  --this->Used;
}

void EdgeFronts::removeAll(std::uint32_t edge)
{
  for (std::uint32_t number = this->Heads[edge]; number != None;)
  {
    const std::uint32_t next = this->Nodes[number].next;
    this->remove(number);
    number = next;
  }
  this->Heads[edge] = None;
}

void EdgeFronts::clear()
{
  for (const std::uint32_t edge : this->Edges)
  {
    this->Heads[edge] = None;
  }
  this->Edges.clear();
  this->Free = None;
  this->Created = this->Used = 0;
  this->Most = LeastMost;
}

/** The insertion of an interval into the list of an edge: walks along the list, appends what stays
 * to what has been walked, and keeps track of which interval is the nearest so far. */
class EdgeFronts::Insertion
{
public:
  Insertion(EdgeFronts& fronts, std::uint32_t edge, const FrontInterval& interval)
    : All(fronts)
    , Edge(edge)
    , New(interval)
    , Rest(fronts.Heads[edge])
    , NewBegin(interval.begin)
  {
  }

  void run()
  {
    while (this->Rest != None && this->All.at(this->Rest).begin < this->New.end)
    {
      const std::uint32_t number = this->Rest;
      this->Rest = this->All.Nodes[number].next;
      this->All.at(number).end <= this->New.begin ? this->append(number) : this->meet(number);
    }
    if (this->IsNewOpen && !this->growsRest())
    {
      this->appendNew(this->New.end);
    }
    this->link(this->Rest);
  }

private:
  /** Walks past an interval that the new one overlaps. */
  void meet(std::uint32_t number)
  {
    this->Number = number;
    this->Old = this->All.at(number);
    this->OldState = this->All.Nodes[number].state;
    this->OldBegin = this->Old.begin;
    this->IsOldKept = this->IsOldOpen = false;
    if (this->Old.begin < this->New.begin)
    {
      this->pass(this->Old.begin, false);
    }
    // The part that both have, between its ends and the borders of the two.
    double from = std::max(this->Old.begin, this->New.begin);
    const double end = std::min(this->Old.end, this->New.end);
    double border[3];
    int borders = crossings(this->Old.image, this->New.image, from, end, border);
    border[borders++] = end;
    for (int k = 0; k < borders; ++k)
    {
      this->pass(from, isNearer(this->New.image, this->Old.image, from, border[k]));
      from = border[k];
    }
    if (this->Old.end > end)
    {
      this->pass(end, false);
    }
    if (this->IsOldOpen)
    {
      this->appendOld(this->Old.end);
    }
    if (!this->IsNewOpen)
    {
      this->IsNewOpen = true;
      this->NewBegin = this->Old.end;
    }
    if (!this->IsOldKept)
    {
      this->All.remove(number);
    }
  }

  /** From this place on, the new interval is the nearest, or the old one. */
  void pass(double begin, bool isNew)
  {
    if (isNew && !this->IsNewOpen)
    {
      this->appendOld(begin);
      this->NewBegin = begin;
    }
    else if (!isNew && this->IsNewOpen)
    {
      this->appendNew(begin);
    }
    if (!isNew && !this->IsOldOpen)
    {
      this->OldBegin = begin;
      this->IsOldOpen = true;
    }
    this->IsNewOpen = isNew;
  }

  /** Appends the open part of the old interval up to this place: the first one stays the node. */
  void appendOld(double end)
  {
    this->IsOldOpen = false;
    if (isEmpty(this->OldBegin, end))
    {
      return;
    }
    if (this->IsOldKept)
    {
      this->appendPart(this->Old, this->OldBegin, end, this->OldState);
      return;
    }
    FrontInterval& kept = this->All.Nodes[this->Number].interval;
    kept.begin = this->OldBegin;
    kept.end = end;
    this->append(this->Number);
    this->IsOldKept = true;
  }

  /** Appends the open part of the new interval up to this place, or lets the one before grow that
   * sees the same image: as paths past both sides of a vertex do where the surface is flat. */
  void appendNew(double end)
  {
    const double begin = this->NewBegin;
    if (isEmpty(begin, end))
    {
      return;
    }
    if (this->isSame(this->Last) && isEmpty(this->All.at(this->Last).end, begin))
    {
      this->All.Nodes[this->Last].interval.end = end;
      this->All.Added.push_back(this->Last);
    }
    else
    {
      this->appendPart(this->New, begin, end, Waiting);
    }
  }

  /** Lets the interval that comes next grow instead, if it sees the same image: at the end alone,
   * since an interval that has grown must not be walked past. */
  bool growsRest()
  {
    if (isEmpty(this->NewBegin, this->New.end) || !this->isSame(this->Rest) ||
        !isEmpty(this->New.end, this->All.at(this->Rest).begin))
    {
      return false;
    }
    this->All.Nodes[this->Rest].interval.begin = this->NewBegin;
    this->All.Added.push_back(this->Rest);
    return true;
  }

  bool isSame(std::uint32_t number) const
  {
    return number != None && this->All.isWaiting(number) && goesOn(this->All.at(number), this->New);
  }

  void appendPart(FrontInterval part, double begin, double end, State state)
  {
    part.begin = begin;
    part.end = end;
    this->append(this->All.create(part, state));
    if (state == Waiting)
    {
      this->All.Added.push_back(this->Last);
    }
  }

  void append(std::uint32_t number)
  {
    this->link(number);
    this->Last = number;
  }
  void link(std::uint32_t next)
  {
    (this->Last == None ? this->All.Heads[this->Edge] : this->All.Nodes[this->Last].next) = next;
  }

  EdgeFronts& All;
  std::uint32_t Edge;
  const FrontInterval& New;
  std::uint32_t Last = None, Rest; ///< of what has been walked; the first of what has not
  bool IsNewOpen = true;           ///< whether the new interval is the nearest so far, from
  double NewBegin;                 ///< here on

  // The interval that is walked past, which may become several.
  std::uint32_t Number = None;
  FrontInterval Old{};
  State OldState = Unused;
  double OldBegin = 0;
  bool IsOldKept = false, IsOldOpen = false;
};

std::span<const std::uint32_t> EdgeFronts::insert(std::uint32_t edge, const FrontInterval& interval)
{
  this->Added.clear();
  const bool isFirst = this->Heads[edge] == None;
  Insertion(*this, edge, interval).run();
  if (isFirst && this->Heads[edge] != None)
  {
    this->Edges.push_back(edge);
  }
  return this->Added;
}

} // namespace smg
