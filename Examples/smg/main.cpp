// SPDX-License-Identifier: BSD-3-Clause
//
// smg: Poisson problems, deformations, smoothing, distances and simplification on meshes of any
// size.
//
//   smg info bunny.ply
//   smg convert bunny.ply bunny.vsm
//   smg solve bunny.vsm harmonic.vtp --problem harmonic.json --report report.json
//   smg deform bunny.vsm bent.ply --handles handles.json --memory 128
//   smg smooth scan.ply smooth.ply --size 4edges
//   smg blend scan.ply blended.ply --patch scan --columns Colors
//   smg distance bunny.vsm distance.vtp --from '{"vertices": [5]}'
//   smg area body.msh areas.vtu --tag PhysicalTag
//   smg simplify scan.ply small.ply --vertices 100000
//   smg preview bunny.vsm preview.vtp --points 5000
//
// Exit status: 0; 1 with one line on standard error; 2 for wrong usage; 3 if the result has not the
// accuracy that was asked for; 128 + n with one line after signal n.

#include "CommonOptions.h"
#include "HtmlReport/Page.h"
#include "MeshCommand.h"
#include "ProgressBar.h"

#include "IO/Jobs/Jobs.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <new>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/** Each in its own file. */
void addConvertCommand(CLI::App& program, Action& action);
void addInfoCommand(CLI::App& program, Action& action);
void addPreviewCommand(CLI::App& program, Action& action);
/** Of jobs with more than the options of their tables. */
void addDeformCommand(CLI::App& program, Action& action, const smg::JobKind& kind);
void addDistanceCommand(CLI::App& program, Action& action, const smg::JobKind& kind);
void addSimplifyCommand(CLI::App& program, Action& action, const smg::JobKind& kind);
void addSolveCommand(CLI::App& program, Action& action, const smg::JobKind& kind);

namespace
{

/** Adds all commands, in the order of the help. */
void addCommands(CLI::App& program, Action& action)
{
  using Add = void (*)(CLI::App&, Action&, const smg::JobKind&);
  const std::map<std::string_view, Add> own{ { "deform", addDeformCommand },
    { "distance", addDistanceCommand }, { "simplify", addSimplifyCommand },
    { "solve", addSolveCommand } };
  addInfoCommand(program, action);
  addConvertCommand(program, action);
  for (const smg::JobKind& kind : smg::jobKinds())
  {
    const auto found = own.find(kind.name);
    (found == own.end() ? addJobCommand : found->second)(program, action, kind);
  }
  addPreviewCommand(program, action);
}

/** Prints an error in one line, without control characters. */
int fail(const std::string& sentence)
{
  std::fprintf(stderr, "smg: %s\n", smg::oneLine(sentence).c_str());
  return 1;
}

/** The exit code of a command that has done its work, unless standard output cannot be written. */
int succeed(int code = 0)
{
  const bool said = std::cout.flush() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  return said ? code
              : fail("standard output cannot be written: make room there, or send it elsewhere");
}

/** The smallest number of characters to insert, remove or replace that makes one word the other. */
std::size_t editsBetween(std::string_view from, std::string_view to)
{
  std::vector<std::size_t> edits(to.size() + 1);
  std::iota(edits.begin(), edits.end(), std::size_t(0));
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    std::size_t diagonal = std::exchange(edits[0], i + 1);
    for (std::size_t k = 0; k < to.size(); ++k)
    {
      const std::size_t replaced = diagonal + (from[i] == to[k] ? 0 : 1);
      diagonal = edits[k + 1];
      edits[k + 1] = std::min({ replaced, diagonal + 1, edits[k] + 1 });
    }
  }
  return edits.back();
}

/** A sentence on an option that the command does not have; empty if there is none. A missing
 * option is often a misspelt one, which the parser would only call missing. */
std::string unknownOption(const CLI::App& command)
{
  for (const std::string& word : command.remaining())
  {
    const std::string name = word.substr(0, word.find('='));
    if (name.size() > 1 && name[0] == '-' && name[1] != '-')
    {
      return word + " begins as an option does: a file of this name is ./" + word +
             ", or comes after --";
    }
    if (!name.starts_with("--") || name.size() < 3)
    {
      continue;
    }
    std::string nearest;
    std::size_t least = 3;
    for (const CLI::Option* option : command.get_options())
    {
      for (const std::string& known : option->get_lnames())
      {
        if (const std::size_t edits = editsBetween(name.substr(2), known); edits < least)
        {
          least = edits;
          nearest = known;
        }
      }
    }
    if (least == 0)
    {
      return name + " comes after --, where all words are names of files: put options before it";
    }
    return name + " is not an option of smg " + command.get_name() +
           (nearest.empty() ? "" : ": did you mean --" + nearest + '?');
  }
  return {};
}

/** Parses the arguments and executes the command. */
int run(int argc, char** argv)
{
  CLI::App program(
    "Streaming multigrid for Poisson problems, deformations, smoothing and distances on meshes of "
    "any size, and their simplification",
    "smg");
  program.set_version_flag("--version", SMG_VERSION);
  program.require_subcommand(1);
  Action action;
  addCommands(program, action);
  if (argc < 2 || std::string_view(argv[1]) == "help")
  {
    std::fputs(program.help().c_str(), argc < 2 ? stderr : stdout);
    return argc < 2 ? 2 : succeed();
  }
  try
  {
    program.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    // Help and version are no errors; everything else is one line, like other errors.
    if (error.get_exit_code() == 0)
    {
      program.exit(error);
      return succeed();
    }
    const std::vector<std::string> rest = program.remaining();
    const std::vector<CLI::App*> commands = program.get_subcommands();
    const bool unknown = commands.empty() && !rest.empty();
    const std::string called = commands.empty() ? "smg" : "smg " + commands.front()->get_name();
    const std::string option = commands.empty() ? "" : unknownOption(*commands.front());
    fail((unknown           ? '\'' + rest.front() + "' is not a command of smg"
           : option.empty() ? error.what()
                            : option) +
         " (" + called + " --help explains the usage)");
    return 2;
  }

  html::rememberCommandLine(argc, argv);
  catchInterrupts();
  return succeed(action());
}

} // namespace

int main(int argc, char** argv)
{
  // A region of the allocator for each thread reserves 64 MiB of address space, which a limit of
  // the system (ulimit -v) counts. Threads hardly allocate while they work: one region does.
  mallopt(M_ARENA_MAX, 1);
  try
  {
    return run(argc, argv);
  }
  catch (const std::bad_alloc&)
  {
    // Without a string, for which there may be no memory either.
    std::fputs(
      "smg: the system is out of memory: lower --memory or close other programs\n", stderr);
    return 1;
  }
  catch (const std::exception& error)
  {
    const int code = fail(error.what());
    const int signal = interruptingSignal();
    return signal != 0 ? 128 + signal : code; // as shells report it
  }
}
