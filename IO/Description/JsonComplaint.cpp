// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Description/JsonComplaint.h"

#include "IO/Files/InQuotes.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace smg
{

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
