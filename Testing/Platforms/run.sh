#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# run.sh SUITE [COMMAND] : runs a command, by default the two commands of the README, with the
# configurations main, benchmarks and nightly, in a fresh clone of the last commit of this tree, in a
# fresh Debian of that release (bookworm, trixie, forky), and removes both. Requires root, and the network
# for the packages.
#
# At the end it prints the elapsed time and, if there is a deformed bunny of Examples/run.sh, whether it
# equals that of the same script on this machine bit for bit; a difference is a failure.
#
# Environment:
#   SMG_PLATFORM_DIR   folder for the system, about 8 GB; default: /var/tmp
#   SMG_KEEP           1: keep the system and print its location
#   SMG_TEST_DATA_DIR  the unpacked archive of test meshes, for the tests; default: none
set -euo pipefail
suite=${1:?usage: run.sh SUITE [COMMAND]}
if [ "$(id -u)" != 0 ]; then
  echo "$0: creating a system requires root: sudo bash $0 $suite" >&2
  exit 1
fi
# The mounts below are visible to this process and its children only, and end with them.
if [ -z "${SMG_PLATFORM_MOUNTS:-}" ]; then
  SMG_PLATFORM_MOUNTS=private exec unshare --mount --propagation private bash "$0" "$@"
fi
shift
both='bash Examples/run.sh && SMG_CONFIGURATIONS="main benchmarks nightly" bash Testing/run.sh'
command=${*:-$both}
tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$tree/cmake/packages.sh"
smg_install debootstrap git

root=$(mktemp -d "${SMG_PLATFORM_DIR:-/var/tmp}/smg-$suite-XXXXXX")
# Readable for all users, as in any system.
chmod 755 "$root"
# Never descends into mounts, which include the devices of this machine.
clean() {
  local mounted
  for mounted in data sys dev proc; do
    ! mountpoint -q "$root/$mounted" || umount -R -l "$root/$mounted"
  done
  if [ "${SMG_KEEP:-}" = 1 ]; then
    echo "The system: $root"
  else
    rm -rf --one-file-system "$root"
  fi
}
trap clean EXIT

# Uses the package source of this machine. Releases unknown to debootstrap are created like sid.
archive=$(grep -hE '^(deb|URIs:)' /etc/apt/sources.list /etc/apt/sources.list.d/* 2> /dev/null |
  grep -oE 'https?:[^ ]*/debian/?( |$)' | head -n 1 | tr -d ' ' || true)
scripts=/usr/share/debootstrap/scripts
script=$scripts/$suite
[ -e "$script" ] || script=$scripts/sid
smg_say_so debootstrap --variant=minbase --include=git,ca-certificates,sudo "$suite" "$root" \
  "${archive:-http://deb.debian.org/debian}" "$script" |
  grep -E '^(I: (Base|Retrieving InRelease)|E:|W:|\.\.\.)'
cp /etc/resolv.conf "$root/etc/"
for settings in /etc/apt/apt.conf.d/*; do
  ! grep -qE 'Acquire::|Proxy' "$settings" || cp "$settings" "$root/etc/apt/apt.conf.d/"
done
for mounted in proc dev sys; do
  mount --rbind "/$mounted" "$root/$mounted"
done
git clone -q "$tree" "$root/tree"
data=
if [ -n "${SMG_TEST_DATA_DIR:-}" ]; then
  mkdir "$root/data"
  mount -o bind,ro "$SMG_TEST_DATA_DIR" "$root/data"
  data=/data
fi

start=$SECONDS
status=0
proxies=()
for variable in http_proxy https_proxy no_proxy; do
  [ -z "${!variable:-}" ] || proxies+=("$variable=${!variable}")
done
chroot "$root" env -i "${proxies[@]}" HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
  SMG_TEST_DATA_DIR="$data" bash -c "cd /tree && { $command; }" || status=$?
echo "$suite: ended with $status after $((SECONDS - start)) s: $command"
if [ -d "$root/tree/Examples/output" ]; then
  bash "$tree/Examples/run.sh" > /dev/null
fi
for name in bunny-deformed.vsm bunny-deformed.ply; do
  here=$tree/Examples/output/$name
  there=$root/tree/Examples/output/$name
  if [ ! -f "$here" ] || [ ! -f "$there" ]; then
    echo "$name: not compared, since it is missing in one of the systems"
  elif cmp -s "$here" "$there"; then
    echo "$name: equals that of this machine"
  else
    echo "$name: differs from that of this machine"
    status=1
  fi
done
exit "$status"
