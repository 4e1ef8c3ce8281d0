// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/XmlTags.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <system_error>

namespace smg
{

namespace
{

/** Longest tag that is read. */
constexpr std::size_t MaxTagBytes = std::size_t(64) << 10;

constexpr std::string_view XmlBlanks = " \t\r\n";

/** A character in UTF-8; empty if there is none of this code. */
std::string utf8Of(std::uint32_t code)
{
  const bool isSurrogate = code >= 0xd800 && code < 0xe000;
  if (code == 0 || code > 0x10ffff || isSurrogate)
  {
    return {};
  }
  if (code < 0x80)
  {
    return { static_cast<char>(code) };
  }
  const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3; // bytes after the first
  constexpr std::array<std::uint32_t, 4> firsts{ 0, 0xc0, 0xe0, 0xf0 };
  std::string text{ static_cast<char>(firsts[std::size_t(more)] | code >> 6 * more) };
  for (int k = more - 1; k >= 0; --k)
  {
    text += static_cast<char>(0x80 | (code >> 6 * k & 0x3f));
  }
  return text;
}

/** The character that an entity stands for, as "lt" or "#65"; empty for others. */
std::string characterOf(std::string_view entity)
{
  constexpr std::pair<std::string_view, char> named[] = { { "lt", '<' }, { "gt", '>' },
    { "amp", '&' }, { "quot", '"' }, { "apos", '\'' } };
  for (const auto& [name, character] : named)
  {
    if (entity == name)
    {
      return { character };
    }
  }
  std::uint32_t code = 0;
  if (entity.starts_with("#"))
  {
    const bool hex = entity.starts_with("#x");
    entity.remove_prefix(hex ? 2 : 1);
    const char* const end = entity.data() + entity.size();
    const auto result = std::from_chars(entity.data(), end, code, hex ? 16 : 10);
    code = result.ec == std::errc() && result.ptr == end ? code : 0;
  }
  return utf8Of(code);
}

std::string unescaped(std::string_view text)
{
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const std::size_t end = text[i] == '&' ? text.find(';', i) : std::string_view::npos;
    const std::string character =
      end == std::string_view::npos ? std::string() : characterOf(text.substr(i + 1, end - i - 1));
    plain += character.empty() ? std::string(1, text[i]) : character;
    i = character.empty() ? i : end;
  }
  return plain;
}

} // namespace

const std::string* XmlTag::attribute(const char* name) const
{
  for (const auto& [own, value] : this->attributes)
  {
    if (own == name)
    {
      return &value;
    }
  }
  return nullptr;
}

bool XmlTags::find()
{
  for (;;)
  {
    const std::string_view text = this->File.at(this->At);
    const std::size_t place = text.find('<');
    if (text.empty() || place != std::string_view::npos)
    {
      this->At += text.empty() ? 0 : place;
      return !text.empty();
    }
    this->At += text.size();
  }
}

void XmlTags::skipPast(std::string_view end)
{
  const std::size_t begin = this->At;
  for (;;)
  {
    const std::string_view text = this->File.at(this->At, MaxTagBytes);
    const std::size_t place = text.find(end);
    if (place != std::string_view::npos)
    {
      this->At += place + end.size();
      return;
    }
    if (this->At + text.size() >= this->File.size())
    {
      this->File.fail(begin, "the file ends within a comment or declaration: it is truncated");
    }
    this->At += text.size() - end.size() + 1;
  }
}

bool XmlTags::next(XmlTag& tag)
{
  while (this->find())
  {
    const std::string_view text = this->File.at(this->At, MaxTagBytes).substr(0, MaxTagBytes);
    if (text.starts_with("<!--"))
    {
      this->skipPast("-->");
    }
    else if (text.starts_with("<![CDATA["))
    {
      this->skipPast("]]>");
    }
    else if (text.starts_with("<?") || text.starts_with("<!"))
    {
      this->skipPast(">");
    }
    else
    {
      char quote = '\0';
      std::size_t end = 1;
      for (; end < text.size() && (quote || text[end] != '>'); ++end)
      {
        const bool isQuote = text[end] == '"' || text[end] == '\'';
        quote = quote ? (text[end] == quote ? '\0' : quote) : (isQuote ? text[end] : '\0');
      }
      if (end >= text.size())
      {
        this->File.fail(this->At, "a tag does not end: the file is truncated or damaged");
      }
      tag.begin = this->At;
      this->At += end + 1;
      tag.end = this->At;
      this->parse(text.substr(1, end - 1), tag);
      return true;
    }
  }
  return false;
}

void XmlTags::parse(std::string_view text, XmlTag& tag) const
{
  tag.closes = text.starts_with('/');
  tag.alone = text.ends_with('/');
  text = text.substr(
    tag.closes, text.size() - std::min<std::size_t>(text.size(), tag.closes + tag.alone));
  const std::size_t nameEnd = std::min(text.find_first_of(XmlBlanks), text.size());
  tag.name = text.substr(0, nameEnd);
  tag.attributes.clear();
  text.remove_prefix(nameEnd);
  for (;;)
  {
    text.remove_prefix(std::min(text.find_first_not_of(XmlBlanks), text.size()));
    if (text.empty())
    {
      return;
    }
    const std::size_t equals = text.find('=');
    const std::size_t open = equals == std::string_view::npos
                               ? std::string_view::npos
                               : text.find_first_not_of(XmlBlanks, equals + 1);
    const bool quoted = open != std::string_view::npos && (text[open] == '"' || text[open] == '\'');
    const std::size_t close = quoted ? text.find(text[open], open + 1) : std::string_view::npos;
    if (close == std::string_view::npos)
    {
      this->File.fail(tag.begin, "an attribute of the tag here has no value: the file is damaged");
    }
    const std::string_view name = text.substr(0, text.find_first_of(" \t\r\n="));
    tag.attributes.emplace_back(name, unescaped(text.substr(open + 1, close - open - 1)));
    text.remove_prefix(close + 1);
  }
}

} // namespace smg
