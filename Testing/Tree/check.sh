#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# check.sh RULE : checks a rule for the files of the tree; prints the files that violate it.
#   layers   VTK only in IO/Vtk and Filters, there not in .cpp; dependencies from Filters to IO to
#            Solver only
#   cycles   no cyclic dependencies between the folders of Solver, IO and Filters
#   format   C++ is formatted according to .clang-format (skipped without clang-format 14)
#   licence  every source file begins with its SPDX line
#   sizes    no file above 2 MB, no source file above 600 lines, no
#            function above 80
#   results  the tables of documents are those of Testing/Benchmarks/results
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# The files of the tree without build folders; a copy that is not a git checkout is searched
# instead.
files() {
  if git rev-parse --is-inside-work-tree > /dev/null 2>&1; then
    git ls-files --cached --others --exclude-standard -- "$@" |
      while read -r file; do
        if [ -f "$file" ]; then echo "$file"; fi
      done
  else
    find . -path './build*' -prune -o -type f -print | sed 's,^\./,,' |
      while read -r file; do
        for pattern in "${@:-*}"; do
          if [[ $file == $pattern ]]; then
            echo "$file"
            break
          fi
        done
      done
  fi
}

fail() {
  echo "$1"
  exit 1
}

# Lines `file:number:#include ...` of the files on stdin whose included name matches the expression.
includes() { xargs -r grep -nHE "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]($1)"; }

layers() {
  local found
  found=$(files 'Solver/*' 'IO/*' 'Filters/*' | grep -E '\.(h|cpp|cxx|txx|hxx)$' |
    grep -vE '^(IO/Vtk|Filters)/.*\.(h|cxx)$' | includes '([^<>"]*/)?vtk[^/"<>]*[">]')
  [ -z "$found" ] || fail "VTK headers outside IO/Vtk and Filters, or there in a .cpp:
$found"
  found=$(files 'IO/Vtk/*' 'Filters/*' | grep -E '\.(h|cxx)$' | includes 'nlohmann/')
  [ -z "$found" ] || fail "JSON in files that include VTK, whose bundled JSON library has the same names:
$found"
  found=$({
    files 'Solver/*' | includes '(IO|Filters|ParaViewPlugin|Examples|Testing)/'
    files 'IO/*' | includes '(Filters|ParaViewPlugin|Examples|Testing)/'
    files 'Filters/*' 'Examples/*' | includes '(ParaViewPlugin|Testing)/'
  })
  [ -z "$found" ] || fail "includes against the direction of the layers:
$found"
}

# Input of tsort: a line for each folder that includes a file of another. Public headers count as one
# folder; SolveWith.h, which brings the engine to programs, as none.
cycles() {
  local found
  found=$(files 'Solver/*' 'IO/*' 'Filters/*' | grep -E '\.(h|cpp|cxx|txx|hxx)$' |
    grep -v '/SolveWith\.h$' | includes '(Solver|IO|Filters|smg)/' |
    sed -E 's,"smg/,"Solver/include/smg/,' |
    sed -nE 's,^(.*)/[^/]*:[0-9]+:[^"]*"([^"]*)/[^"/]*".*,\1 \2,p' | awk '$1 != $2' | sort -u |
    tsort 2>&1 > /dev/null)
  [ -z "$found" ] || fail "cyclic dependencies between folders:
$found"
}

format() {
  local program
  for program in clang-format-14 clang-format; do
    "$program" --version 2> /dev/null | grep -q 'version 14\.' && break
    program=
  done
  if [ -z "$program" ]; then
    echo "SKIPPED: clang-format 14 is not installed"
    exit 77
  fi
  files '*.h' '*.cpp' '*.cxx' '*.txx' '*.hxx' | xargs -r "$program" --dry-run -Werror ||
    fail "not formatted: run $program -i on the files above"
}

licence() {
  local found
  found=$(files '*.h' '*.cpp' '*.cxx' '*.txx' '*.hxx' '*.py' '*.sh' '*.cmake' '*.in' '*CMakeLists.txt' '.ci/run' |
    tr '\n' '\0' | xargs -r0 awk '
      FNR == 1 { if (NR > 1 && !is_licensed) print file; file = FILENAME; is_licensed = 0 }
      FNR <= 3 && /SPDX-License-Identifier: BSD-3-Clause/ { is_licensed = 1 }
      FNR == 4 { nextfile }
      END { if (!is_licensed) print file }')
  [ -z "$found" ] || fail "no SPDX-License-Identifier: BSD-3-Clause in the first three lines of:
$found"
}

sizes() {
  local found
  found=$(files | tr '\n' '\0' | xargs -r0 stat -c '%s %n' | awk '$1 > 2000000')
  [ -z "$found" ] || fail "files above 2 MB:
$found"
  found=$(files '*.h' '*.cpp' '*.cxx' '*.txx' '*.hxx' | xargs -r awk '
    FNR == 601 { print FILENAME ": more than 600 lines" }')
  [ -z "$found" ] || fail "source files that are too long:
$found"
  # As clang-format lays functions out: between a brace alone in a line and one below it, while
  # classes end in "};" and namespaces in a comment.
  found=$(files '*.h' '*.cpp' '*.cxx' '*.txx' '*.hxx' | xargs -r awk '
    /^ *\{$/ { begin[length($0)] = FNR }
    /^ *\}$/ {
      lines = FNR - begin[length($0)] - 1
      if (lines > 80) print FILENAME ":" begin[length($0)] ": " lines " lines"
    }')
  [ -z "$found" ] || fail "functions above 80 lines:
$found"
}

results() { python3 Testing/Benchmarks/document.py --check; }

case "${1:-}" in
  layers | cycles | format | licence | sizes | results) "$1" ;;
  *)
    sed -n '3,10s/^# //p' "$0" >&2
    exit 2
    ;;
esac
