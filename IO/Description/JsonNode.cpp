// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Description/JsonNode.h"

#include "IO/Files/FileNames.h"
#include "Solver/Core/Text.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

namespace smg
{

void JsonNode::requireObject(std::span<const char* const> keys) const
{
  if (!this->Value->is_object())
  {
    this->fail("must be an object");
  }
  for (const auto& item : this->Value->items())
  {
    const bool known =
      std::any_of(keys.begin(), keys.end(), [&item](const char* key) { return item.key() == key; });
    if (!known)
    {
      std::string names;
      for (const char* key : keys)
      {
        names += names.empty() ? key : std::string(", ") + key;
      }
      this->child(item.value(), item.key()).fail("is not known here; the keys are " + names);
    }
  }
}

JsonNode JsonNode::member(const char* key) const
{
  const auto found = this->Value->find(key);
  if (found == this->Value->end())
  {
    this->fail(std::string("has no '") + key + '\'');
  }
  return this->child(*found, key);
}

std::vector<JsonNode> JsonNode::elements() const
{
  this->requireArray();
  std::vector<JsonNode> nodes;
  for (std::size_t i = 0; i < this->Value->size(); ++i)
  {
    nodes.push_back(this->element(i));
  }
  return nodes;
}

std::string JsonNode::string() const
{
  if (!this->Value->is_string())
  {
    this->fail("must be a string");
  }
  return this->Value->get<std::string>();
}

std::string JsonNode::columnName() const
{
  const std::string name = this->string();
  if (name.empty())
  {
    this->fail("must be the name of a column");
  }
  return name;
}

double JsonNode::number() const
{
  if (!this->Value->is_number() || !std::isfinite(this->Value->get<double>()))
  {
    this->fail("must be a finite number");
  }
  return this->Value->get<double>();
}

namespace
{

bool isIntegerIn(const nlohmann::json& value, std::int64_t least, std::int64_t most)
{
  const bool fits = value.is_number_unsigned()
                      ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(most)
                      : value.is_number_integer();
  return fits && value.get<std::int64_t>() >= least && value.get<std::int64_t>() <= most;
}

} // namespace

std::int64_t JsonNode::integer(std::int64_t least, std::int64_t most) const
{
  if (!isIntegerIn(*this->Value, least, most))
  {
    this->fail("must be an integer from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return this->Value->get<std::int64_t>();
}

std::vector<std::int64_t> JsonNode::integers(std::int64_t least, std::int64_t most) const
{
  this->requireArray();
  std::vector<std::int64_t> integers;
  integers.reserve(this->Value->size());
  for (const nlohmann::json& value : *this->Value)
  {
    // Creating a node, with its place, would cost more than parsing the number.
    integers.push_back(isIntegerIn(value, least, most)
                         ? value.get<std::int64_t>()
                         : this->element(integers.size()).integer(least, most));
  }
  return integers;
}

std::vector<double> JsonNode::numbers(std::size_t count) const
{
  if (!this->Value->is_array() || this->Value->size() != count)
  {
    this->fail(
      "must be an array of " + std::to_string(count) + (count == 1 ? " number" : " numbers"));
  }
  std::vector<double> numbers;
  for (const JsonNode& node : this->elements())
  {
    numbers.push_back(node.number());
  }
  return numbers;
}

void JsonNode::fail(const std::string& sentence) const
{
  throw Error(
    oneLine(this->File + ": " + (this->Place.empty() ? "" : this->Place + ": ") + sentence + '.'));
}

void JsonNode::requireArray() const
{
  if (!this->Value->is_array())
  {
    this->fail("must be an array");
  }
}

JsonNode JsonNode::element(std::size_t i) const
{
  return this->child((*this->Value)[i], '[' + std::to_string(i) + ']');
}

JsonNode JsonNode::child(const nlohmann::json& value, const std::string& step) const
{
  JsonNode node(value, this->File);
  const bool dot = !this->Place.empty() && step[0] != '[';
  node.Place = this->Place + (dot ? "." : "") + step;
  return node;
}

namespace
{

/** Larger descriptions are refused: their values take up to thirty times their text in memory. */
constexpr std::int64_t MaxFileBytes = std::int64_t(16) << 20;
/** Of arrays and objects in each other. */
constexpr std::size_t MaxDepth = 100;

/**
 * A first pass over a text, which rejects duplicate keys, of which the parser would silently use
 * the last, and values in too many others. Not a callback of the parser: with one it looks through
 * all elements of an array after each object in it.
 */
class KeyCheck : public nlohmann::json_sax<nlohmann::json>
{
public:
  explicit KeyCheck(std::string file)
    : File(std::move(file))
  {
  }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_array(std::size_t) override { return this->begin(); }
  bool end_array() override { return this->end(); }
  bool start_object(std::size_t) override { return this->begin(); }
  bool end_object() override { return this->end(); }
  bool key(string_t& key) override
  {
    if (!this->Open.back().insert(key).second)
    {
      throw Error(this->File + ": the key " + inQuotes(key) +
                  " occurs twice in the same object: remove one.");
    }
    return true;
  }
  /** The parser itself reports it. */
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override
  {
    return false;
  }

private:
  bool begin()
  {
    this->Open.emplace_back();
    if (this->Open.size() > MaxDepth)
    {
      throw Error(this->File + ": has values in more than " + std::to_string(MaxDepth) +
                  " arrays and objects, one in another: no description needs so many.");
    }
    return true;
  }
  bool end()
  {
    this->Open.pop_back();
    return true;
  }

  std::string File;
  std::vector<std::set<std::string>> Open; ///< the keys of the open objects; none of arrays
};

} // namespace

std::string jsonFileText(const std::string& path)
{
  std::error_code absent;
  if (std::filesystem::is_directory(path, absent))
  {
    throw Error(path + ": this is a folder: name a JSON file.");
  }
  const FileDescriptor file = FileDescriptor::openForReading(path);
  const std::int64_t size = file.size();
  if (size == 0)
  {
    throw Error(path + ": the file is empty or cannot be read.");
  }
  if (size > MaxFileBytes)
  {
    throw Error(path + ": has " + mebibytes(size) + ", but may have at most " +
                mebibytes(MaxFileBytes) +
                ": name large parts of a mesh by one of its columns (\"mask\" or \"tag\").");
  }
  std::string text(static_cast<std::size_t>(size), '\0');
  file.read(0, std::as_writable_bytes(std::span(text)));
  return text;
}

nlohmann::json readJsonFile(const std::string& path)
{
  return readJsonText(jsonFileText(path), path);
}

nlohmann::json readJsonText(const std::string& text, const std::string& file)
{
  try
  {
    KeyCheck check(file);
    nlohmann::json::sax_parse(text, &check);
    return nlohmann::json::parse(text);
  }
  catch (const nlohmann::json::exception& error)
  {
    // Without the library's name of the exception, "[json.exception.parse_error.101] ".
    const std::string_view what(error.what());
    const std::size_t name = what.find("] ");
    throw Error(file + ": this is not valid JSON: " +
                oneLine(std::string(what.substr(name == what.npos ? 0 : name + 2))) + '.');
  }
}

} // namespace smg
