// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** A value of a JSON file with its place, so that every error message names the file and the place,
 * for example `problem.json: dirichlet[1].box: must be 6 numbers.` */
class SMG_EXPORT JsonNode
{
public:
  /** The value of the whole file, which must outlive the nodes. */
  JsonNode(const nlohmann::json& value, std::string file)
    : Value(&value)
    , File(std::move(file))
  {
  }

  const nlohmann::json& value() const { return *this->Value; }
  /** The place in the file, for example `dirichlet[1].box`; empty for the whole. */
  const std::string& place() const { return this->Place; }

  /** Throws Error unless the value is an object with no other keys than these. */
  void requireObject(std::span<const char* const> keys) const;
  void requireObject(std::initializer_list<const char*> keys) const
  {
    this->requireObject(std::span<const char* const>(keys.begin(), keys.size()));
  }
  bool has(const char* key) const { return this->Value->contains(key); }
  /** The member of an object; throws Error if there is none. */
  JsonNode member(const char* key) const;
  /** The elements of an array; throws Error if the value is not an array. */
  std::vector<JsonNode> elements() const;

  bool isTrue() const { return this->Value->is_boolean() && this->Value->get<bool>(); }
  bool isString() const { return this->Value->is_string(); }
  std::string string() const;
  /** The name of a column: a string that is not empty. */
  std::string columnName() const;
  /** A finite number. */
  double number() const;
  /** An integer in [least, most]. */
  std::int64_t integer(std::int64_t least, std::int64_t most) const;
  /** An array of integers in [least, most], possibly very long. */
  std::vector<std::int64_t> integers(std::int64_t least, std::int64_t most) const;
  /** An array of `count` finite numbers. */
  std::vector<double> numbers(std::size_t count) const;

  /** Throws Error: "FILE: PLACE: SENTENCE.", or "FILE: SENTENCE." for the whole. */
  [[noreturn]] void fail(const std::string& sentence) const;

private:
  JsonNode child(const nlohmann::json& value, const std::string& step) const;
  JsonNode element(std::size_t i) const;
  void requireArray() const;

  const nlohmann::json* Value;
  std::string File;
  std::string Place;
};

/** The text of a JSON file; throws Error if it cannot be read, is empty, is not a regular file or
 * has more than 16 MiB. */
SMG_EXPORT std::string jsonFileText(const std::string& path);
/** Reads a JSON file; throws Error with file, line and column if it is invalid. */
nlohmann::json readJsonFile(const std::string& path);
/** The same for a string, named `name` in error messages. */
SMG_EXPORT nlohmann::json readJsonText(const std::string& text, const std::string& name);

} // namespace smg
