#!/usr/bin/env bash
# Installs from Debian whatever of the packages below is missing. Does nothing when all are there.
. "$(dirname "$0")/common.sh"

packages=(
  build-essential cmake ninja-build ccache pkg-config ca-certificates dpkg-dev git debian-archive-keyring
  libopenmpi-dev openmpi-bin libfftw3-dev libeigen3-dev libgtest-dev libbenchmark-dev
  python3 python3-numpy python3-matplotlib python3-vtk9 xvfb
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' || missing+=("$package")
done

if [ ${#missing[@]} -gt 0 ]; then
  say "installing ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  as_root apt-get update -q
  as_root apt-get install -y -q --no-install-recommends "${missing[@]}"
fi
