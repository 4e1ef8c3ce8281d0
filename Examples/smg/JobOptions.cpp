// SPDX-License-Identifier: BSD-3-Clause
#include "JobOptions.h"

#include "IO/Jobs/ReadOptions.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <utility>

// The command line has texts, which become the JSON of a description: the same reader checks both,
// with the name of the option for the place.

namespace
{

/** Of a WHERE that may be a file instead. */
bool isJson(const std::string& given)
{
  return given.starts_with('{') || given.starts_with('[');
}

/** A number, if the text is one; else the text, which the reader refuses. */
template <class Number>
nlohmann::json numberOrText(const std::string& text)
{
  Number number = {};
  const char* const end = text.data() + text.size();
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [rest, error] = std::from_chars(begin, end, number);
  return error == std::errc() && rest == end ? nlohmann::json(number) : nlohmann::json(text);
}

/** The parts of a list "a,b", which may be empty: as many as commas, and one. */
std::vector<std::string> splitAtCommas(const std::string& list)
{
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= list.size();)
  {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    parts.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/** The value of an option as a description has it. */
nlohmann::json valueOf(const smg::JobOption& option, const std::vector<std::string>& texts)
{
  if (smg::isKind<smg::ColumnsOption>(option))
  {
    nlohmann::json names = nlohmann::json::array();
    for (const std::string& list : texts)
    {
      std::ranges::copy(splitAtCommas(list), std::back_inserter(names));
    }
    return names;
  }
  const std::string& text = texts.back();
  return smg::isKind<smg::NumberOption>(option)  ? numberOrText<double>(text)
         : smg::isKind<smg::CountOption>(option) ? numberOrText<std::int64_t>(text)
         : smg::isKind<smg::FlagOption>(option)  ? nlohmann::json(text == "true")
                                                 : nlohmann::json(text);
}

/** Sets an option of a kind other than WHERE. */
void set(const smg::JobOption& option, const std::string& name,
  const std::vector<std::string>& texts, smg::Job& job)
{
  const nlohmann::json value = valueOf(option, texts);
  smg::readOption(smg::JsonNode(value, name), option, job);
}

/** What is wrong with a text, without the name of its option and the end of the sentence, which the
 * parser adds. What the file of a WHERE says is no matter of the usage. */
std::string wrongWith(
  const smg::JobOption& option, const std::string& name, const std::string& text, smg::Job& job)
{
  try
  {
    if (!smg::isKind<smg::WhereOption>(option))
    {
      set(option, name, { text }, job);
    }
    else if (isJson(text))
    {
      smg::readPlacesText(text, name);
    }
    return text.empty() ? "an empty text is not one" : "";
  }
  catch (const smg::Error& error)
  {
    std::string sentence = error.what();
    const std::string prefix = name + ": ";
    sentence.erase(0, sentence.starts_with(prefix) ? prefix.size() : 0);
    sentence.erase(sentence.find_last_not_of('.') + 1);
    return sentence;
  }
}

/** What the help says of the values of an option. */
std::string typeName(const smg::JobOption& option, const nlohmann::ordered_json& row)
{
  const std::string kind = row["kind"];
  if (kind == "choice")
  {
    std::string names;
    for (const auto& name : row["choices"])
    {
      names += (names.empty() ? "" : "|") + name.get<std::string>();
    }
    return names;
  }
  if (const auto* number = std::get_if<smg::NumberOption>(&option.kind))
  {
    return std::string("NUMBER") + (number->zero ? std::string("|") + number->zero : "");
  }
  return kind == "count"     ? "N"
         : kind == "column"  ? "COLUMN"
         : kind == "columns" ? "COLUMN,..."
         : kind == "where"   ? "WHERE"
                             : "SIZE";
}

/** The option of the command line with this key. */
std::string nameOf(std::string key)
{
  std::ranges::replace(key, '_', '-');
  return "--" + key;
}

/** A sentence on an option. */
std::string helpOn(const nlohmann::ordered_json& row)
{
  std::string help = row["help"];
  if (row["kind"] == "where")
  {
    help += ", as WHERE of a problem file: JSON, as '{\"sphere\": [0, 0, 0, 1]}', a list of these, "
            "or a file; may be given several times";
  }
  if (row.contains("unit"))
  {
    help += "; in " + row["unit"].get<std::string>();
  }
  if (row.contains("allowed") && row["kind"] != "choice")
  {
    help += " (" + row["allowed"].get<std::string>() + ')';
  }
  return help;
}

/** A default as it would be given. */
std::string textOf(const nlohmann::ordered_json& value)
{
  return value.is_string()         ? value.get<std::string>()
         : value.is_number_float() ? CLI::detail::to_string(value.get<double>())
                                   : value.dump();
}

} // namespace

void JobOptions::addTo(CLI::App& command, smg::Job& job)
{
  const nlohmann::ordered_json rows = smg::describe(job);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const smg::JobOption& option = job.table()[i];
    if (option.isCommon || smg::isKind<smg::DescriptionOption>(option))
    {
      continue;
    }
    Entry& entry = this->Entries.emplace_back(Entry{ &option, nameOf(option.key), {} });
    const auto exclude = [&](CLI::Option* added)
    {
      for (const char* const other : option.excludes)
      {
        if (other)
        {
          added->excludes(command.get_option(nameOf(other)));
        }
      }
    };
    if (smg::isKind<smg::FlagOption>(option))
    {
      const bool isOn = rows[i].value("default", false);
      exclude(command.add_flag_function(
        entry.name + (isOn ? ",!--no-" + entry.name.substr(2) : ""),
        [&entry, &job](std::int64_t count)
        {
          entry.texts = { count > 0 ? "true" : "false" };
          set(*entry.option, entry.name, entry.texts, job);
        },
        option.help + std::string(isOn ? " (default), or do not" : "")));
      continue;
    }
    CLI::Option* const added = command.add_option(entry.name, entry.texts, helpOn(rows[i]))
                                 ->allow_extra_args(false)
                                 ->check([&entry, &job](const std::string& text)
                                   { return wrongWith(*entry.option, entry.name, text, job); })
                                 ->type_name(typeName(option, rows[i]))
                                 ->required(option.isRequired);
    if (!smg::isKind<smg::WhereOption>(option) && !smg::isKind<smg::ColumnsOption>(option))
    {
      added->expected(1);
    }
    if (rows[i].contains("default"))
    {
      added->default_str(textOf(rows[i]["default"]));
    }
    exclude(added);
  }
}

bool JobOptions::isGiven(std::string_view key) const
{
  return std::ranges::any_of(this->Entries,
    [key](const Entry& entry) { return key == entry.option->key && !entry.texts.empty(); });
}

void JobOptions::apply(smg::Job& job) const
{
  for (const Entry& entry : this->Entries)
  {
    if (entry.texts.empty())
    {
      continue;
    }
    const auto* where = std::get_if<smg::WhereOption>(&entry.option->kind);
    if (!where)
    {
      set(*entry.option, entry.name, entry.texts, job);
      continue;
    }
    std::vector<smg::Where> places;
    for (const std::string& text : entry.texts)
    {
      std::ranges::move(
        isJson(text) ? smg::readPlacesText(text, entry.name) : smg::readPlacesFile(text),
        std::back_inserter(places));
    }
    where->member.set(job, std::move(places));
  }
}

void JobOptions::addFiles(smg::UsedFiles& files) const
{
  for (const Entry& entry : this->Entries)
  {
    for (const std::string& text : entry.texts)
    {
      if (smg::isKind<smg::WhereOption>(*entry.option))
      {
        files.read(isJson(text) ? "" : text, "the file of " + entry.name);
      }
    }
  }
}
