// SPDX-License-Identifier: BSD-3-Clause
//
// smg: Poisson problems on meshes of any size.
//
//   smg info bunny.ply
//   smg convert bunny.ply bunny.vsm
//   smg solve bunny.vsm harmonic.vtp --problem harmonic.json --report report.json
//
// Answers 0, or 1 with one line on standard error, or 2 if it was called wrongly.

#include "CommonOptions.h"
#include "Interrupt.h"

#include "Solver/Core/Error.h"

#include <cstdio>
#include <exception>
#include <new>
#include <string>

namespace
{

/** An error is one line, whatever the library or the system put into it. */
int fail(std::string sentence)
{
  for (char& c : sentence)
  {
    c = c == '\n' || c == '\r' ? ' ' : c;
  }
  std::fprintf(stderr, "smg: %s\n", sentence.c_str());
  return 1;
}

} // namespace

int main(int argc, char** argv)
{
  CLI::App program("Streaming multigrid for Poisson problems on meshes of any size", "smg");
  program.set_version_flag("--version", SMG_VERSION);
  program.require_subcommand(1);
  Action action;
  addInfoCommand(program, action);
  addConvertCommand(program, action);
  addSolveCommand(program, action);
  try
  {
    program.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    // Help and version are answers; everything else is one line, like the other errors.
    if (error.get_exit_code() == 0)
    {
      return program.exit(error);
    }
    fail(std::string(error.what()) + " (smg --help says how it is called)");
    return 2;
  }

  catchInterrupts();
  try
  {
    action();
    return 0;
  }
  catch (const std::bad_alloc&)
  {
    return fail("the system has no more memory: lower --memory or close other programs");
  }
  catch (const std::exception& error)
  {
    return fail(error.what());
  }
}
