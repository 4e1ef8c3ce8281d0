// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Processes/StreamNumbers.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace smg
{
namespace
{

constexpr std::int64_t None = -1;

/** A global id at the process where all that have it meet. */
struct Claim
{
  std::int64_t id = 0;
  std::int64_t isUsed = 0;
};

/** The different ids of this process, ascending. */
std::vector<Claim> claimsOf(std::span<const std::int64_t> ids, std::span<const char> isUsed)
{
  std::vector<Claim> claims;
  claims.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (ids[i] < 0)
    {
      throw Error("The input has the negative point GlobalId " + std::to_string(ids[i]) + ".");
    }
    claims.push_back({ ids[i], isUsed[i] });
  }
  std::ranges::sort(claims, [](const Claim& a, const Claim& b)
    { return a.id != b.id ? a.id < b.id : a.isUsed > b.isUsed; });
  const auto same = std::ranges::unique(claims, {}, &Claim::id);
  claims.erase(same.begin(), same.end());
  return claims;
}

/** The place where the claims to an id meet: item `place` from process `process`. */
struct Meeting
{
  Claim claim;
  std::size_t process = 0, place = 0;
};

/** All claims at this process, those to an id together, the first one that of its owner. */
std::vector<Meeting> meetingsOf(const std::vector<std::vector<Claim>>& received)
{
  std::vector<Meeting> meetings;
  for (std::size_t p = 0; p < received.size(); ++p)
  {
    for (std::size_t k = 0; k < received[p].size(); ++k)
    {
      meetings.push_back({ received[p][k], p, k });
    }
  }
  std::ranges::stable_sort(meetings,
    [](const Meeting& a, const Meeting& b) {
      return a.claim.id != b.claim.id ? a.claim.id < b.claim.id : a.claim.isUsed > b.claim.isUsed;
    });
  return meetings;
}

template <class T, class U>
std::vector<std::vector<T>> sameSizes(const std::vector<std::vector<U>>& others, T value)
{
  std::vector<std::vector<T>> result;
  for (const auto& other : others)
  {
    result.emplace_back(other.size(), value);
  }
  return result;
}

/** For each claim, whether this process owns the point. */
std::vector<std::vector<char>> ownedOf(
  Team& team, const std::vector<std::vector<Claim>>& received, const std::vector<Meeting>& meetings)
{
  auto owns = sameSizes(received, char(0));
  for (std::size_t m = 0; m < meetings.size(); ++m)
  {
    const Meeting& meeting = meetings[m];
    if (m > 0 && meetings[m - 1].claim.id == meeting.claim.id)
    {
      continue;
    }
    if (!meeting.claim.isUsed)
    {
      throw Error("The point with the GlobalId " + std::to_string(meeting.claim.id) +
                  " belongs to no cell of any process: clean the mesh first.");
    }
    owns[meeting.process][meeting.place] = 1;
  }
  return team.exchange(owns);
}

/** The number that the owner of each claimed point has given it. */
std::vector<std::vector<std::int64_t>> spread(Team& team,
  const std::vector<std::vector<std::int64_t>>& given, const std::vector<Meeting>& meetings)
{
  std::vector<std::vector<std::int64_t>> numbers = team.exchange(given);
  std::int64_t number = None;
  for (const Meeting& meeting : meetings)
  {
    std::int64_t& place = numbers[meeting.process][meeting.place];
    number = place != None ? place : number;
    place = number;
  }
  return team.exchange(numbers);
}

} // namespace

StreamNumbers numberPoints(
  Team& team, std::span<const std::int64_t> ids, std::span<const char> isUsed)
{
  const std::vector<Claim> claims = claimsOf(ids, isUsed);
  const auto processes = static_cast<std::size_t>(team.size());
  const auto placeOf = [processes](const Claim& claim)
  { return static_cast<std::size_t>(claim.id) % processes; };
  std::vector<std::vector<Claim>> sent(processes);
  for (const Claim& claim : claims)
  {
    sent[placeOf(claim)].push_back(claim);
  }
  const std::vector<std::vector<Claim>> received = team.exchange(sent);
  const std::vector<Meeting> meetings = meetingsOf(received);
  const std::vector<std::vector<char>> owned = ownedOf(team, received, meetings);

  std::int64_t count = 0;
  for (const std::vector<char>& some : owned)
  {
    count += std::ranges::count(some, 1);
  }
  const std::vector<std::int64_t> counts = team.gather(std::vector<std::int64_t>{ count });
  StreamNumbers result;
  result.first = std::accumulate(counts.begin(), counts.begin() + team.rank(), std::int64_t(0));
  result.end = result.first + count;
  result.total = std::accumulate(counts.begin(), counts.end(), std::int64_t(0));

  auto given = sameSizes(owned, None);
  std::vector<std::size_t> next(processes);
  std::int64_t number = result.first;
  for (const Claim& claim : claims)
  {
    const std::size_t p = placeOf(claim), k = next[p]++;
    if (owned[p][k])
    {
      given[p][k] = number++;
    }
  }
  const std::vector<std::vector<std::int64_t>> numbers = spread(team, given, meetings);
  std::ranges::fill(next, std::size_t(0));
  std::vector<std::int64_t> ofClaims;
  for (const Claim& claim : claims)
  {
    const std::size_t p = placeOf(claim);
    ofClaims.push_back(numbers[p][next[p]++]);
  }
  for (const std::int64_t id : ids)
  {
    const auto claim = std::ranges::lower_bound(claims, id, {}, &Claim::id);
    result.numbers.push_back(ofClaims[static_cast<std::size_t>(claim - claims.begin())]);
  }
  return result;
}

} // namespace smg
