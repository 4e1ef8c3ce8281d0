// SPDX-License-Identifier: BSD-3-Clause
// ExpandTables TEMPLATE.xml PARTS.xml PROXIES.xml : writes the server-manager XML of a template, in
// which properties and suffixes come from the tables of the library (IO/Jobs/JobOption.h,
// IO/Formats/FormatTable.h), and what several proxies have alike from PARTS.xml:
//
//   <Part name="Solve" default="1"/>
//     is the definition of this name, with the values of its attributes at {default} and the like.
//   <Option job="blend" key="anchor"/>
//     is the property of this option: name, label, command, default, range, choices, documentation.
//     Attributes say what is to differ in a panel: `name`, of an option that the table gives none;
//     `visibility` (of advanced options "advanced"), `default`, `slider` (the upper end that a
//     panel shows: "table", that of the table, or a number; a range with two ends is shown as a
//     slider), `more` (sentences after the documentation), `documentation` (instead of it) and
//     `widget`. What the element contains, as domains of arrays and hints, becomes part of the
//     property.
//   @indexed compressed -ele@
//     are suffixes of formats: of `streams` or of `indexed` meshes that are read, of those that are
//     `written` here alone or by VTK as well (`written-by-vtk`), `compressed`, and without some.

#include "IO/Description/OptionValues.h"
#include "IO/Files/Decompressor.h"
#include "IO/Formats/FormatTable.h"
#include "IO/Jobs/JobOption.h"
#include "IO/Jobs/JobProperties.h"
#include "IO/Jobs/Jobs.h"
#include "IO/Jobs/ReadOptions.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace
{

using Attributes = std::map<std::string, std::string>;

std::string replaced(std::string text, std::string_view from, std::string_view to)
{
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
  {
    text.replace(at, from.size(), to);
    at += to.size();
  }
  return text;
}

std::string escaped(std::string text)
{
  for (const auto& [from, to] : { std::pair("&", "&amp;"), { "<", "&lt;" }, { ">", "&gt;" } })
  {
    text = replaced(std::move(text), from, to);
  }
  return text;
}

/** "Keep Volume" for "KeepVolume". */
std::string labelOf(const std::string& name)
{
  std::string label;
  for (const char c : name)
  {
    const bool isNext = !label.empty() && std::isupper(static_cast<unsigned char>(c)) != 0;
    label += isNext ? std::string(" ") + c : std::string(1, c);
  }
  return label;
}

/** What panels call a choice. */
std::string titleOf(std::string name)
{
  constexpr std::pair<std::string_view, const char*> Titles[] = { { "auto", "Automatic" },
    { "cg", "Conjugate Gradients" } };
  const auto* const title =
    std::ranges::find(Titles, name, &std::pair<std::string_view, const char*>::first);
  if (title != std::end(Titles))
  {
    return title->second;
  }
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

/** What a panel says of an option: the words of VTK instead of those of the library. */
std::string helpOf(const smg::JobOption& option, const std::string& name)
{
  constexpr std::pair<std::string_view, std::string_view> Words[] = { { "a column", "an array" },
    { "columns", "arrays" }, { "column", "array" }, { "Columns", "Arrays" }, { "Column", "Array" },
    { "vertices", "points" }, { "vertex", "point" }, { " auto:", " Automatic:" },
    { "or cg", "or Conjugate Gradients" } };
  const auto* number = std::get_if<smg::NumberOption>(&option.kind);
  std::string text = replaced(option.help, '(' + std::string(option.key) + ')', '(' + name + ')');
  text = number && number->zero ? replaced(text, number->zero + std::string(":"), "0:") : text;
  for (const auto& [from, to] : Words)
  {
    text = replaced(std::move(text), from, to);
  }
  const std::string range = number                                  ? smg::inWords(number->range)
                            : smg::isKind<smg::CountOption>(option) ? smg::allowedValues(option)
                                                                    : "";
  const std::string unit = number && *number->unit ? std::string("in ") + number->unit : "";
  const std::string notes = unit + (unit.empty() || range.empty() ? "" : "; ") + range;
  text += (notes.empty() ? "" : " (" + notes + ')') + '.';
  const bool isWhere = smg::isKind<smg::WhereOption>(option);
  return text + (isWhere ? " WHERE of a problem file in JSON, or a list of these, for example "
                           "{\"sphere\": [0, 0, 0, 1]}."
                         : "");
}

/** A property for an option of each kind. */
class PropertyXml
{
public:
  PropertyXml(
    const smg::JobOption& option, const smg::Job& job, const Attributes& given, std::string content)
    : Option(option)
    , Job(job)
    , Given(given)
    , Content(std::move(content))
  {
    this->Name = this->given("name").empty() ? smg::propertyOf(option) : this->given("name");
    if (this->Name.empty())
    {
      throw smg::Error(std::string(option.key) + ": give it a name");
    }
  }

  std::string operator()(const smg::NumberOption& option) const
  {
    const double number = option.member.get(this->Job).value_or(0.0);
    return this->property("Double", smg::shortest(std::isfinite(number) ? number : 0.0),
      this->range("Double", option.range.least, option.range.most));
  }
  std::string operator()(const smg::CountOption& option) const
  {
    const std::optional<std::int64_t> number = option.member.get(this->Job);
    return this->property("Int", std::to_string(number.value_or(0)),
      this->range(
        "Int", number ? static_cast<double>(option.least) : 0.0, static_cast<double>(option.most)));
  }
  std::string operator()(const smg::FlagOption& option) const
  {
    return this->property(
      "Int", *option.member.get(this->Job) ? "1" : "0", "<BooleanDomain name=\"bool\"/>\n");
  }
  std::string operator()(const smg::ChoiceOption& option) const
  {
    const std::optional<std::size_t> chosen = option.member.get(this->Job);
    std::vector<std::string> titles(chosen ? 0 : 1, "Automatic");
    std::ranges::transform(option.names, std::back_inserter(titles), titleOf);
    std::string entries;
    for (std::size_t i = 0; i < titles.size(); ++i)
    {
      entries += "  <Entry text=\"" + titles[i] + "\" value=\"" + std::to_string(i) + "\"/>\n";
    }
    return this->property("Int", std::to_string(chosen.value_or(0)),
      "<EnumerationDomain name=\"enum\">\n" + entries + "</EnumerationDomain>\n");
  }
  /** An array of the input, which the content lists. */
  std::string operator()(const smg::ColumnOption& /*option*/) const
  {
    return this->property("String", "None", "", " animateable=\"0\"");
  }
  std::string operator()(const smg::ColumnsOption& /*option*/) const
  {
    const std::string one = this->Name.substr(0, this->Name.size() - 1);
    return this->property("String", {}, "",
      " command=\"Add" + one + "\" clean_command=\"RemoveAll" + this->Name +
        "\" repeat_command=\"1\" number_of_elements_per_command=\"1\" number_of_elements=\"0\""
        " animateable=\"0\"");
  }
  std::string operator()(const smg::WhereOption& /*option*/) const
  {
    return this->property("String", "", "");
  }
  std::string operator()(const smg::FolderOption& /*option*/) const
  {
    return this->property(
      "String", "", "<FileListDomain name=\"files\"/>\n<Hints>\n  <UseDirectoryName/>\n</Hints>\n");
  }
  std::string operator()(const auto& /*others*/) const
  {
    throw smg::Error(std::string(this->Option.key) + ": write its property");
  }

private:
  std::string given(const char* attribute) const
  {
    const auto found = this->Given.find(attribute);
    return found == this->Given.end() ? std::string() : found->second;
  }

  std::string range(const char* type, double least, double most) const
  {
    const std::string slider = this->given("slider");
    const std::string max = slider == "table" ? smg::shortest(most) : slider;
    return '<' + std::string(type) + "RangeDomain name=\"range\" min=\"" + smg::shortest(least) +
           (max.empty() ? "" : "\" max=\"" + max) + "\"/>\n";
  }

  std::string documentation() const
  {
    if (const std::string text = this->given("documentation"); !text.empty())
    {
      return text;
    }
    const std::string more = this->given("more");
    return escaped(helpOf(this->Option, this->Name)) + (more.empty() ? "" : ' ' + more);
  }

  /** @param further attributes instead of those of a single value, or besides them */
  std::string property(const std::string& type, std::optional<std::string> value,
    const std::string& domain, const std::string& further = {}) const
  {
    const std::string visibility = this->given("visibility").empty() && this->Option.isAdvanced
                                     ? "advanced"
                                     : this->given("visibility");
    const std::string tag = type + "VectorProperty";
    std::string xml =
      '<' + tag + " name=\"" + this->Name + "\" label=\"" + labelOf(this->Name) + '"';
    if (value)
    {
      const std::string instead = this->given("default");
      xml += " command=\"Set" + this->Name + "\" number_of_elements=\"1\" default_values=\"" +
             (instead.empty() ? *value : instead) + '"';
    }
    xml += further;
    const bool isDefault = visibility.empty() || visibility == "default";
    xml += isDefault ? "" : " panel_visibility=\"" + visibility + '"';
    xml += this->given("widget").empty() ? "" : " panel_widget=\"" + this->given("widget") + '"';
    return xml + ">\n" + domain + "<Documentation>" + this->documentation() + "</Documentation>\n" +
           this->Content + "</" + tag + ">";
  }

  const smg::JobOption& Option;
  const smg::Job& Job;
  const Attributes& Given;
  std::string Name, Content;
};

std::string propertyXml(const Attributes& given, std::string content)
{
  const std::string key = given.at("key");
  const std::unique_ptr<smg::Job> job = smg::makeJob(given.at("job"));
  const std::span<const smg::JobOption> table = job->table();
  const auto option = std::ranges::find(table, key, &smg::JobOption::key);
  if (option == table.end())
  {
    throw smg::Error(given.at("job") + " has no option " + key);
  }
  return std::visit(PropertyXml(*option, *job, given, std::move(content)), option->kind);
}

/** The attributes of an element from `at` on, which is then behind them. */
Attributes attributesAt(const std::string& text, std::size_t& at)
{
  Attributes found;
  for (at = text.find_first_not_of(" \n", at); text.at(at) != '/' && text[at] != '>';
       at = text.find_first_not_of(" \n", at))
  {
    const std::size_t equals = text.find('=', at), end = text.find(text.at(equals + 1), equals + 2);
    found[text.substr(at, equals - at)] = text.substr(equals + 2, end - equals - 2);
    at = end + 1;
  }
  return found;
}

/** What replaces an element with these attributes and this content. */
using Replacement = std::function<std::string(Attributes given, std::string content)>;

/** The text with all elements of this name, which do not contain each other, replaced. */
std::string replacedElements(
  const std::string& text, const std::string& name, const Replacement& replacement)
{
  const std::string begin = '<' + name + ' ', end = "</" + name + '>';
  std::string result;
  std::size_t done = 0;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, done))
  {
    result += text.substr(done, at - done);
    at += begin.size();
    Attributes given = attributesAt(text, at);
    std::string content;
    done = at + 2;
    if (text[at] == '>')
    {
      const std::size_t stop = text.find(end, at);
      content = text.substr(at + 1, stop - at - 1);
      done = stop + end.size();
    }
    result += replacement(std::move(given), std::move(content));
  }
  return result + text.substr(done);
}

/** What parts stand for. */
class Definitions
{
public:
  explicit Definitions(const std::string& text)
  {
    replacedElements(text, "Definition",
      [this](Attributes given, std::string content)
      {
        const std::string name = given.at("name");
        this->Known.emplace(name, std::pair(std::move(given), std::move(content)));
        return std::string();
      });
  }

  std::string withParts(const std::string& text) const
  {
    return replacedElements(text, "Part",
      [this](Attributes given, std::string content)
      {
        const auto found = this->Known.find(given.at("name"));
        if (found == this->Known.end())
        {
          throw smg::Error("there is no part " + given.at("name"));
        }
        const auto& [defaults, body] = found->second;
        given.emplace("content", std::move(content));
        given.insert(defaults.begin(), defaults.end());
        return this->withParts(filled(body, given));
      });
  }

private:
  /** With the values of attributes in place of their names in braces. */
  static std::string filled(const std::string& body, const Attributes& values)
  {
    std::string result;
    std::size_t done = 0;
    for (std::size_t at = body.find('{'); at != std::string::npos; at = body.find('{', done))
    {
      const std::size_t end = body.find('}', at);
      const std::string name = body.substr(at + 1, end - at - 1);
      if (!values.contains(name))
      {
        throw smg::Error(values.at("name") + " needs the attribute " + name);
      }
      result += body.substr(done, at - done) + values.at(name);
      done = end + 1;
    }
    return result + body.substr(done);
  }

  std::map<std::string, std::pair<Attributes, std::string>> Known;
};

std::string textOf(const char* path)
{
  std::ifstream in(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in)
  {
    throw smg::Error(std::string(path) + " cannot be read");
  }
  return text;
}

bool isIn(const smg::Format& format, const std::string& group)
{
  using smg::FormatUse;
  const auto can = [&format](FormatUse use)
  { return smg::suffixFor(use, "mesh" + std::string(format.suffixes.front().text)) != nullptr; };
  const bool isIndexed = format.kind == smg::MeshFileKind::Indexed;
  if (group == "streams" || group == "indexed")
  {
    return can(FormatUse::Read) && isIndexed == (group == "indexed");
  }
  return can(FormatUse::Write) && format.isReadByVtk == (group == "written-by-vtk");
}

/** As "indexed compressed -ele". */
std::string suffixes(const std::string& asked)
{
  std::istringstream words(asked);
  std::string group;
  words >> group;
  std::vector<std::string> without, endings{ "" };
  for (std::string word; words >> word;)
  {
    if (word == "compressed")
    {
      endings.assign(smg::CompressedSuffixes.begin(), smg::CompressedSuffixes.end());
    }
    else
    {
      without.push_back('.' + word.substr(1));
    }
  }
  std::string list;
  for (const smg::Format* format : smg::formats())
  {
    for (const smg::FileSuffix& suffix : format->suffixes)
    {
      // What may be text is compressed; other files are so by themselves.
      const bool isMeant = isIn(*format, group) && std::ranges::count(without, suffix.text) == 0 &&
                           (endings.size() == 1 || suffix.form != smg::FileForm::Binary);
      for (std::size_t i = 0; isMeant && i < endings.size(); ++i)
      {
        list += (list.empty() ? "" : " ") + std::string(suffix.text.substr(1)) + endings[i];
      }
    }
  }
  return list;
}

std::string withSuffixes(const std::string& text)
{
  std::string result;
  std::size_t done = 0;
  for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@', done))
  {
    const std::size_t end = text.find('@', at + 1);
    result += text.substr(done, at - done) + suffixes(text.substr(at + 1, end - at - 1));
    done = end + 1;
  }
  return result + text.substr(done);
}

} // namespace

int main(int argc, char** argv)
{
  try
  {
    if (argc != 4)
    {
      throw smg::Error("usage: ExpandTables TEMPLATE.xml PARTS.xml PROXIES.xml");
    }
    const std::string parts = Definitions(textOf(argv[2])).withParts(textOf(argv[1]));
    std::ofstream out(argv[3], std::ios::binary);
    out << withSuffixes(replacedElements(parts, "Option", propertyXml)) << std::flush;
    if (!out)
    {
      throw smg::Error("cannot be written");
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s: %s\n", argc > 1 ? argv[1] : "ExpandTables", error.what());
    return 1;
  }
}
