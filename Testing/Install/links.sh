#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# links.sh PREFIX: of what is installed there, the libraries without VTK and smg load neither MPI nor
# hypre; only the libraries of the distributed engine do, if they are installed.
set -euo pipefail
prefix=$1
mpi='lib(mpi|open-rte|open-pal|HYPRE)'

checked=0
for file in "$prefix"/bin/smg "$prefix"/lib*/libsmg*.so "$prefix"/lib*/*/libsmg*.so; do
  [ -f "$file" ] || continue
  [ "$(basename "$file")" != libsmgDistributed.so ] || continue
  if ldd "$file" | grep -E "$mpi"; then
    echo "$file loads these libraries of MPI or hypre" >&2
    exit 1
  fi
  checked=$((checked + 1))
done
if [ "$checked" -lt 3 ]; then
  echo "$prefix: only $checked of smg, libsmgSolver and libsmgIOCore are installed" >&2
  exit 1
fi

# The engine does, which shows that the names above are those of this system.
for file in "$prefix"/lib*/libsmgDistributed.so "$prefix"/lib*/*/libsmgDistributed.so; do
  [ -f "$file" ] || continue
  for library in mpi HYPRE; do
    if ! readelf -d "$file" | grep -q "NEEDED.*lib$library"; then
      echo "$file does not load lib$library" >&2
      exit 1
    fi
  done
done
