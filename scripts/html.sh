#!/usr/bin/env bash
# Writes doc/ and the READMEs as HTML with search to build/html; open index.html there. Whatever
# warns, and any link that leads nowhere, is an error. Needs no network once its packages are there.
. "$(dirname "$0")/common.sh"

"$ROOT/scripts/dependencies.sh"

pages=$BUILD/html
say "writing $pages"
# to know LAMMPS's pages
export LAMMPS_SOURCE_DIR=${LAMMPS_SOURCE_DIR:-$CACHE/lammps-4Feb2025/source}
rm -rf "$pages"
PYTHONDONTWRITEBYTECODE=1 "$PYTHON" -m sphinx -W --keep-going -q -c "$ROOT/doc" "$ROOT" "$pages" ||
  fail "pages are not as they should be (see above)"
rm -r "$pages/.doctrees"
say "open $pages/index.html"
