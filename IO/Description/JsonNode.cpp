// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Description/JsonNode.h"

#include "IO/Files/FileNames.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
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

/**
 * A parser callback that rejects duplicate keys, of which the parser would silently use the last.
 */
class UniqueKeys
{
public:
  explicit UniqueKeys(std::string file)
    : File(std::move(file))
  {
  }

  bool operator()(int, nlohmann::json::parse_event_t event, const nlohmann::json& parsed)
  {
    if (event == nlohmann::json::parse_event_t::object_start)
    {
      this->Objects.emplace_back();
    }
    else if (event == nlohmann::json::parse_event_t::object_end)
    {
      this->Objects.pop_back();
    }
    else if (event == nlohmann::json::parse_event_t::key &&
             !this->Objects.back().insert(parsed.get<std::string>()).second)
    {
      throw Error(this->File + ": the key " + inQuotes(parsed.get<std::string>()) +
                  " occurs twice in the same object: remove one.");
    }
    return true;
  }

private:
  std::string File;
  std::vector<std::set<std::string>> Objects; ///< the keys of the open objects
};

} // namespace

std::string jsonFileText(const std::string& path)
{
  std::error_code absent;
  if (std::filesystem::is_directory(path, absent))
  {
    throw Error(path + ": this is a folder: name a JSON file.");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
  {
    throw Error(path + ": cannot be opened: " + std::strerror(errno) + '.');
  }
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (stream.bad() || text.empty())
  {
    throw Error(path + (text.empty() ? ": the file is empty or cannot be read."
                                     : ": the file cannot be read."));
  }
  return text;
}

nlohmann::json readJsonFile(const std::string& path)
{
  return readJsonText(jsonFileText(path), path);
}

nlohmann::json readJsonText(const std::string& text, const std::string& name)
{
  try
  {
    return nlohmann::json::parse(text, UniqueKeys(name));
  }
  catch (const nlohmann::json::exception&)
  {
    throw Error(name + ", " + jsonComplaint(text) + '.');
  }
}

namespace
{

using Json = nlohmann::json;

/**
 * Accepts all events and keeps the error of the parser, which alone locates numbers out of range.
 */
class ErrorKeeper : public nlohmann::json_sax<Json>
{
public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(
    std::size_t position, const std::string& token, const Json::exception& error) override
  {
    this->Position = position;
    this->Token = token;
    this->Message = error.what();
    this->IsOutOfRange = dynamic_cast<const Json::out_of_range*>(&error) != nullptr;
    return false;
  }

  std::size_t Position = 0; ///< bytes read; one more at the end of the text
  std::string Token;        ///< the last one read
  std::string Message;
  bool IsOutOfRange = false;
};

bool isWordPart(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

/** The letters and digits from a position on, with a preceding sign. */
std::string_view wordAt(std::string_view text, std::size_t begin)
{
  std::size_t end = begin + (begin < text.size() && text[begin] == '-' ? 1 : 0);
  while (end < text.size() && isWordPart(text[end]))
  {
    ++end;
  }
  return text.substr(begin, end - begin);
}

bool isNotFinite(std::string_view word)
{
  std::string name(word.substr(word.starts_with('-') ? 1 : 0));
  std::transform(name.begin(), name.end(), name.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name == "nan" || name == "inf" || name == "infinity";
}

/** The reason in the message of the parser: the text after the dash, without the rest. */
std::string shortReason(const std::string& message)
{
  const std::size_t dash = message.find(" - ");
  const std::size_t begin = dash == std::string::npos ? 0 : dash + 3;
  return message.substr(begin, message.find(';', begin) - begin);
}

/** The position of the error. */
std::size_t beginOf(std::string_view text, const ErrorKeeper& error)
{
  if (error.Position == 0 || error.Position > text.size())
  {
    return text.size();
  }
  const std::string reason = shortReason(error.Message);
  // Only for these, the token is exactly the text that was read.
  if (error.IsOutOfRange || reason == "unexpected number literal" ||
      reason == "unexpected string literal")
  {
    return error.Position - std::min(error.Position, error.Token.size());
  }
  std::size_t begin = error.Position - 1;
  if (reason.starts_with("invalid string") || !isWordPart(text[begin]))
  {
    return begin;
  }
  while (begin > 0 && isWordPart(text[begin - 1]))
  {
    --begin;
  }
  return begin > 0 && text[begin - 1] == '-' ? begin - 1 : begin;
}

std::string reasonAt(std::string_view text, std::size_t begin, const ErrorKeeper& error)
{
  const std::string reason = shortReason(error.Message);
  const std::string_view word = wordAt(text, begin);
  if (isNotFinite(word))
  {
    return "NaN and Infinity are no JSON numbers";
  }
  if (begin == text.size() || reason == "unexpected end of input")
  {
    return "unexpected end";
  }
  if (reason == "invalid literal")
  {
    return word.size() > 1 ? "unexpected word " + inQuotes(word)
                           : "unexpected character " + inQuotes(text.substr(begin, 1));
  }
  return reason;
}

std::string placeOf(std::string_view text, std::size_t byte)
{
  const std::string_view before = text.substr(0, byte);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  const std::size_t lineBegin = before.rfind('\n') + 1; // 0 if there is none
  const std::string_view line = before.substr(lineBegin);
  // All bytes of a UTF-8 character except the first begin with the bits 10.
  const auto characters = std::count_if(
    line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; });
  return "line " + std::to_string(lines + 1) + ", column " + std::to_string(characters + 1);
}

} // namespace

std::string jsonComplaint(const std::string& text)
{
  ErrorKeeper error;
  Json::sax_parse(text, &error);
  const std::string place = placeOf(text, beginOf(text, error)) + ": ";
  return error.IsOutOfRange
           ? place + "the number " + inQuotes(error.Token) + " is out of range"
           : place + "this is not valid JSON: " + reasonAt(text, beginOf(text, error), error);
}

} // namespace smg
