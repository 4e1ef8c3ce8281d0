// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Fields.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <span>
#include <string>

// Structures with fields as JSON: with the entries that are shown, for people and scripts, or with
// all of them, from which the structure is restored.

namespace smg
{

template <class T>
inline constexpr bool isList = false;
template <class T>
inline constexpr bool isList<std::vector<T>> = true;
template <class T>
inline constexpr bool isOptionalField = false;
template <class T>
inline constexpr bool isOptionalField<std::optional<T>> = true;

/** A value, or a structure with its entries that are shown. A structure that is shown in a form of
 * its own has a function shownJson(). */
template <bool HasAll, class T>
nlohmann::ordered_json jsonOf(const T& value)
{
  if constexpr (!HasAll && requires { shownJson(value); })
  {
    return shownJson(value);
  }
  else if constexpr (HasFields<T>)
  {
    nlohmann::ordered_json out = nlohmann::ordered_json::object();
    forFields<T>(
      [&](const auto& field)
      {
        if (HasAll || field.isShown(value, value.*field.member))
        {
          out[field.key] = jsonOf<HasAll>(value.*field.member);
        }
      });
    return out;
  }
  else if constexpr (isList<T>)
  {
    nlohmann::ordered_json out = nlohmann::ordered_json::array();
    for (const auto& element : value)
    {
      out.push_back(jsonOf<HasAll>(element));
    }
    return out;
  }
  else if constexpr (isOptionalField<T>)
  {
    return value ? jsonOf<HasAll>(*value) : nlohmann::ordered_json();
  }
  else
  {
    return value;
  }
}

/** Restores what jsonOf<true>() has made. */
template <class T>
void restore(T& value, const nlohmann::ordered_json& json)
{
  if constexpr (HasFields<T>)
  {
    forFields<T>([&](const auto& field) { restore(value.*field.member, json.at(field.key)); });
  }
  else if constexpr (isList<T>)
  {
    value.clear();
    for (const auto& element : json)
    {
      restore(value.emplace_back(), element);
    }
  }
  else if constexpr (isOptionalField<T>)
  {
    value.reset();
    if (!json.is_null())
    {
      restore(value.emplace(), json);
    }
  }
  else
  {
    json.get_to(value);
  }
}

/** A structure as bytes, with all of its figures. */
template <HasFields T>
std::vector<std::uint8_t> packed(const T& value)
{
  return nlohmann::ordered_json::to_cbor(jsonOf<true>(value));
}

template <HasFields T>
void unpack(T& value, std::span<const std::uint8_t> bytes)
{
  restore(value, nlohmann::ordered_json::from_cbor(bytes.begin(), bytes.end()));
}

/** A structure as a part of a state, for StateWriter and StateReader. */
template <HasFields T>
struct FieldsState
{
  T& value;

  template <class State>
  void save(State& state)
  {
    std::vector<std::uint8_t> bytes = packed(this->value);
    state.part("report");
    state(bytes);
  }
  template <class State>
  void load(State& state)
  {
    std::vector<std::uint8_t> bytes;
    state.part("report");
    state(bytes);
    try
    {
      unpack(this->value, bytes);
    }
    catch (const nlohmann::json::exception&)
    {
      state.fail("its report is damaged");
    }
  }
};

/** What the fields of a structure are: an array of objects with `key`, `kind` ("count", "number",
 * "flag", "text" or "entries"), and `list` if there are several. */
template <HasFields T>
nlohmann::ordered_json describeFields()
{
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  forFields<T>(
    [&](const auto& field)
    {
      using Member = std::remove_cvref_t<decltype(std::declval<T>().*field.member)>;
      const auto kindOf = []<class Value>(std::type_identity<Value>)
      {
        return std::is_same_v<Value, bool>          ? "flag"
               : std::is_integral_v<Value>          ? "count"
               : std::is_floating_point_v<Value>    ? "number"
               : std::is_same_v<Value, std::string> ? "text"
                                                    : "entries";
      };
      if constexpr (isList<Member>)
      {
        rows.push_back({ { "key", field.key },
          { "kind", kindOf(std::type_identity<typename Member::value_type>()) },
          { "list", true } });
      }
      else
      {
        rows.push_back({ { "key", field.key }, { "kind", kindOf(std::type_identity<Member>()) } });
      }
    });
  return rows;
}

} // namespace smg
