// SPDX-License-Identifier: BSD-3-Clause
#include "HtmlReport/Figures.h"

#include "HtmlReport/Text.h"

#include <algorithm>
#include <iterator>

namespace html
{

namespace
{

bool isListOfObjects(const Json& value)
{
  return value.is_array() && !value.empty() &&
         std::ranges::all_of(value, [](const Json& element) { return element.is_object(); });
}

/** Names and values, those of objects with the name of the object before theirs; lists of objects
 * become tables. */
struct FlatFigures
{
  Table pairs;
  std::string tables;

  void add(const std::string& name, const Json& value)
  {
    if (value.is_object())
    {
      for (const auto& [member, inner] : value.items())
      {
        this->add(name.empty() ? member : name + ' ' + member, inner);
      }
    }
    else if (isListOfObjects(value))
    {
      this->tables += "<h3>" + escape(nameText(name)) + "</h3>\n" + tableOf(value);
    }
    else
    {
      this->pairs.rows.push_back({ nameText(name), valueText(name, value) });
    }
  }
};

} // namespace

std::string nameText(const std::string& name)
{
  std::string words = name;
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string valueText(const std::string& name, const Json& value)
{
  if (value.is_array())
  {
    std::string list;
    for (const Json& element : value)
    {
      list += (list.empty() ? "" : ", ") + valueText(name, element);
    }
    return list.empty() ? "none" : list;
  }
  if (value.is_string())
  {
    return value.get<std::string>();
  }
  if (value.is_boolean())
  {
    return value.get<bool>() ? "yes" : "no";
  }
  if (value.is_null())
  {
    return "unknown";
  }
  if (!value.is_number())
  {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  const bool isBytes = name.find("bytes") != std::string::npos || name == "scratch_free" ||
                       name == "output_free" || name == "memory_limit";
  if (isBytes)
  {
    return bytes(value.get<double>());
  }
  if (name.find("seconds") != std::string::npos)
  {
    return seconds(value.get<double>());
  }
  return value.is_number_integer() ? count(value.get<std::int64_t>()) : number(value.get<double>());
}

std::string table(const Table& table)
{
  const auto cell = [&](const char* kind, std::size_t column, const std::string& text)
  {
    const bool isText = column < table.isText.size() && table.isText[column];
    const bool isHead = isText && column == 0;
    const std::string element = isHead ? "th" : kind;
    return '<' + element + (isHead && *kind == 't' && kind[1] == 'd' ? " scope=\"row\"" : "") +
           (isText ? " class=\"text\">" : ">") + escape(text) + "</" + element + '>';
  };
  std::string out = "<div class=\"table\"><table>";
  if (!table.head.empty())
  {
    out += "<thead><tr>";
    for (std::size_t i = 0; i < table.head.size(); ++i)
    {
      out += cell("th", i, table.head[i]);
    }
    out += "</tr></thead>";
  }
  out += "<tbody>";
  for (const std::vector<std::string>& row : table.rows)
  {
    out += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      out += cell("td", i, row[i]);
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string tableOf(const Json& objects)
{
  Json members; // of any of them
  for (const Json& object : objects)
  {
    members.update(object);
  }
  Table out;
  for (const auto& [name, value] : members.items())
  {
    out.head.push_back(nameText(name));
  }
  for (const Json& object : objects)
  {
    std::vector<std::string>& row = out.rows.emplace_back();
    for (const auto& [name, value] : members.items())
    {
      row.push_back(object.contains(name) ? valueText(name, object[name]) : "");
    }
  }
  return table(out);
}

std::string furtherFigures(const Json& entries)
{
  FlatFigures all;
  all.add("", entries);
  return (all.pairs.rows.empty() ? "" : table(all.pairs)) + all.tables;
}

double numberOf(const Json& object, const char* name)
{
  const auto found = object.find(name);
  return found != object.end() && found->is_number() ? found->get<double>() : 0.0;
}

std::int64_t countOf(const Json& object, const char* name)
{
  const auto found = object.find(name);
  return found != object.end() && found->is_number() ? found->get<std::int64_t>() : 0;
}

} // namespace html
