// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/TextNumbers.h"

#include "IO/Files/FileNames.h"
#include "IO/Files/MicrosoftNumbers.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>
#include <type_traits>

namespace smg
{

namespace
{

bool isTextBlank(char c)
{
  return (c == ' ') | (static_cast<unsigned char>(c - '\t') <= '\r' - '\t');
}

bool endsWord(char c)
{
  return isTextBlank(c) || c == '<';
}

constexpr std::size_t StretchBytes = 64;

/** The words that begin in a stretch of text after its first character; -1 if it has a '<'. Without
 * branches, so that compilers use vector instructions. */
int beginningWords(const char* text)
{
  std::uint8_t words = 0, ends = text[0] == '<';
  for (std::size_t i = 1; i < StretchBytes; ++i)
  {
    words += static_cast<std::uint8_t>(isTextBlank(text[i - 1]) & !isTextBlank(text[i]));
    ends |= static_cast<std::uint8_t>(text[i] == '<');
  }
  return ends ? -1 : words;
}

/** Parses a number; null if there is none or the type cannot represent it. */
template <class T>
const char* parse(const char* begin, const char* end, T& value)
{
  // The parsers do not accept a leading plus sign, which occurs in files.
  begin += end - begin > 1 && begin[0] == '+' && begin[1] != '-' ? 1 : 0;
  if constexpr (std::is_floating_point_v<T>)
  {
    const auto result = fast_float::from_chars(begin, end, value);
    return result.ec == std::errc::invalid_argument ? nullptr : result.ptr;
  }
  else
  {
    const auto result = std::from_chars(begin, end, value);
    return result.ec != std::errc() ? nullptr : result.ptr;
  }
}

/** The same for a word such as 1.#QNAN, which the parsers take for a number and a rest. */
template <class T>
const char* parseOther(const char* begin, const char* end, T& value)
{
  const char* const wordEnd = std::find_if(begin, end, endsWord);
  const auto number = parseMicrosoft({ begin, static_cast<std::size_t>(wordEnd - begin) });
  if (!std::is_floating_point_v<T> || !number)
  {
    return nullptr;
  }
  value = static_cast<T>(*number);
  return wordEnd;
}

} // namespace

std::string_view TextNumbers::rest()
{
  for (;;)
  {
    const std::string_view text = this->File.at(this->At, MaxLetters);
    const auto* const word = std::find_if_not(text.begin(), text.end(), isTextBlank);
    this->At += static_cast<std::size_t>(word - text.begin());
    const std::string_view rest(word, static_cast<std::size_t>(text.end() - word));
    const bool all = this->At + rest.size() >= this->File.size();
    if (rest.size() >= MaxLetters || all)
    {
      return !rest.empty() && rest.front() == '<' ? std::string_view() : rest;
    }
  }
}

template <class T>
std::size_t TextNumbers::readAs(T* values, std::size_t count)
{
  std::size_t done = 0;
  while (done < count)
  {
    const std::string_view text = this->rest();
    if (text.empty())
    {
      break;
    }
    // Words that may be truncated at the end of the buffer are left for the next call.
    const bool all = this->At + text.size() >= this->File.size();
    const char* const end = text.data() + text.size();
    const char* const last = all ? end : end - MaxLetters + 1;
    const char* at = text.data();
    while (done < count && at < last && *at != '<')
    {
      const char* stop = parse(at, end, values[done]);
      if (stop && stop < end && *stop == '#')
      {
        stop = parseOther(at, end, values[done]);
      }
      if (!stop || (stop < end ? !endsWord(*stop) : !all))
      {
        const char* const wordEnd = std::find_if(at, end, endsWord);
        this->File.fail(this->At + static_cast<std::size_t>(at - text.data()),
          inQuotes({ at, static_cast<std::size_t>(wordEnd - at) }) + " is not a number of type " +
            std::string(nameOf(scalarTypeOf<T>())) + ", where one should be");
      }
      ++done;
      at = std::find_if_not(stop, end, isTextBlank);
    }
    this->At += static_cast<std::size_t>(at - text.data());
  }
  return done;
}

std::size_t TextNumbers::read(ScalarType type, std::byte* values, std::size_t count)
{
  return dispatch(
    type, [&]<class T>(T) { return this->readAs(reinterpret_cast<T*>(values), count); });
}

std::int64_t TextNumbers::skip(std::int64_t count)
{
  std::int64_t done = 0;
  bool inWord = false;
  while (done < count || inWord)
  {
    const std::string_view text = this->File.at(this->At);
    const char* at = text.data();
    const char* const end = at + text.size();
    while (end - at >= std::ptrdiff_t(StretchBytes) && count - done > std::int64_t(StretchBytes))
    {
      const int words = beginningWords(at);
      if (words < 0)
      {
        break;
      }
      done += words + (!inWord && !isTextBlank(*at));
      at += StretchBytes;
      inWord = !isTextBlank(at[-1]);
    }
    for (; at < end && *at != '<'; ++at)
    {
      const bool letter = !isTextBlank(*at);
      if (letter && !inWord)
      {
        if (done == count)
        {
          break;
        }
        ++done;
      }
      else if (!letter && inWord && done == count)
      {
        inWord = false;
        break;
      }
      inWord = letter;
    }
    this->At += static_cast<std::size_t>(at - text.data());
    if (at < end || text.empty())
    {
      break;
    }
  }
  return done;
}

} // namespace smg
