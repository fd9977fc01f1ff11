#!/usr/bin/env bash
# Installs from Debian whatever of the packages below is missing, and of those named as arguments.
# Does nothing when all are there.
. "$(dirname "$0")/common.sh"

packages=(
  build-essential cmake ninja-build ccache pkg-config ca-certificates dpkg-dev git
  debian-archive-keyring
  libopenmpi-dev openmpi-bin libfftw3-dev libeigen3-dev libgtest-dev libbenchmark-dev
  python3 python3-numpy python3-matplotlib python3-pil python3-vtk9 xvfb
  python3-sphinx python3-sphinx-rtd-theme python3-myst-parser libjs-mathjax
)

packages+=("$@")

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' ||
    missing+=("$package")
done

[ ${#missing[@]} -gt 0 ] || exit 0

# sudo that would ask for a password asks only a person.
as_root=()
if [ "$(id -u)" != 0 ]; then
  as_root=(sudo)
  [ -t 0 ] || as_root+=(-n)
fi
by_hand="these Debian packages are missing: ${missing[*]}"
command -v apt-get >/dev/null ||
  fail "$by_hand (there is no apt-get here: install what they hold by other means)"
[ ${#as_root[@]} = 0 ] || "${as_root[@]}" true 2>/dev/null ||
  fail "$by_hand; install them as root: apt-get install --no-install-recommends ${missing[*]}"

say "installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
{ "${as_root[@]}" apt-get update -q &&
  "${as_root[@]}" apt-get install -y -q --no-install-recommends "${missing[@]}"; } ||
  fail "$by_hand, and could not be installed (see above): is there a network?"
