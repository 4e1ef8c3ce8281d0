// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <tuple>
#include <type_traits>
#include <vector>

// The members of a report, listed once: Fields<Report>. Its JSON, what a checkpoint or another
// process has of it (FieldsJson.h), the sum of several, and the types of Python follow the list.

namespace smg
{

/** A member: its key, how the member of several computations, one after the other, follows from
 * theirs, and whether people and scripts are shown it. */
template <class Owner, class Member, class Total, class Shown>
struct Field
{
  const char* key;
  Member Owner::*member;
  Total add;     ///< (total, next)
  Shown isShown; ///< of (owner, member)
};

/** The fields of a structure, a tuple in the order of its JSON; nullptr: it is no such structure.
 */
template <class T>
inline constexpr auto Fields = nullptr;

template <class T>
concept HasFields = !std::is_same_v<std::remove_cv_t<decltype(Fields<T>)>, std::nullptr_t>;

/** Calls `visit` with each field of a structure. */
template <class T>
constexpr void forFields(const auto& visit)
{
  std::apply([&visit](const auto&... fields) { (visit(fields), ...); }, Fields<T>);
}

/** Adds the report of a further computation to that of those before it. */
template <class T>
void addFields(T& total, const T& next)
{
  forFields<T>([&](const auto& field) { field.add(total.*field.member, next.*field.member); });
}

/** Empties the lists of entries, as of passes, of a structure and of those that it has. */
template <class T>
void clearLists(T& owner)
{
  forFields<T>(
    [&owner]<class Owner, class Member, class Total, class Shown>(
      const Field<Owner, Member, Total, Shown>& field)
    {
      Member& member = owner.*field.member;
      if constexpr (requires { requires HasFields<typename Member::value_type>; })
      {
        if constexpr (requires { member.clear(); })
        {
          member.clear();
        }
        else if (member)
        {
          clearLists(*member);
        }
      }
      else if constexpr (HasFields<Member>)
      {
        clearLists(member);
      }
    });
}

/** How totals are formed. */
namespace total
{
inline constexpr auto None = [](auto&, const auto&) {};
inline constexpr auto Last = [](auto& all, const auto& next) { all = next; };
inline constexpr auto Sum = [](auto& all, const auto& next) { all += next; };
inline constexpr auto Largest = [](auto& all, const auto& next) { all = std::max(all, next); };
inline constexpr auto All = [](bool& all, bool next) { all = all && next; };
inline constexpr auto Each = [](auto& all, const auto& next) { addFields(all, next); };
/** Lists one after the other. */
inline constexpr auto Joined = [](auto& all, const auto& next)
{ all.insert(all.end(), next.begin(), next.end()); };
/** Lists one after the other, without what is there already. */
inline constexpr auto Distinct = [](auto& all, const auto& next)
{
  std::ranges::copy_if(next, std::back_inserter(all),
    [&all](const auto& element) { return std::ranges::find(all, element) == all.end(); });
};
} // namespace total

/** Which entries are shown. */
namespace shown
{
inline constexpr auto Always = [](const auto&, const auto&) { return true; };
/** Lists and texts that are not empty, figures that there are. */
inline constexpr auto IfAny = [](const auto&, const auto& value)
{
  if constexpr (requires { value.empty(); })
  {
    return !value.empty();
  }
  else
  {
    return value.has_value();
  }
};
} // namespace shown

template <class Owner, class Member, class Total = decltype(total::None),
  class Shown = decltype(shown::Always)>
constexpr auto field(
  const char* key, Member Owner::*member, Total add = total::None, Shown isShown = shown::Always)
{
  return Field<Owner, Member, Total, Shown>{ key, member, add, isShown };
}

} // namespace smg
