#!/usr/bin/env bash
# Installs the package of deb.sh in a new, minimal Debian below a temporary folder, runs a cell in
# shear there and says how long each took. As root.
#   usage: try_deb.sh [FILE.deb [SUITE]]     the suite that it is for, or else that of this machine
. "$(dirname "$0")/common.sh"

package=${1:-$(ls -t "$BUILD"-deb/*.deb 2>/dev/null | head -n 1)}
[ -f "$package" ] || fail "there is no package: bash scripts/deb.sh makes it"
. "$ROOT/scripts/clean_debian.sh"

new_debian "${2:-$(debian_release)}"
cp "$package" "$debian/root/user-rbc.deb"
cat >"$debian/root/in.scene" <<'SCENE'
variable        potentials getenv LAMMPS_POTENTIALS
units           micro
atom_style      molecular
boundary        p p f
region          box block 0 12 0 12 0 12
create_box      1 box angle/types 1
include         ${potentials}/healthy.material
molecule        rbc ${potentials}/rbc_162.mol
rbc/create      rbc single 6 6 6
neighbor        1.0 bin
fix             mem  all rbc/membrane rbc mooney-rivlin ${C1} ${C2} ${h} bending ${kappa}
fix             flow all rbc/fluid dx 0.8 viscosity ${viscosity} wall zlo 0 0 0 wall zhi 0.0012 0 0
fix             ib   all rbc/ib flow
compute         cell all rbc/cell
thermo_style    custom step time c_cell[1][5] c_cell[1][6]
thermo          10
timestep        200
run             100
SCENE

install="apt-get update -q && apt-get install -y -q /root/user-rbc.deb"
timed "installing $(basename "$package")" inside bash -c "$install"
timed "a cell in shear on 1 task" inside lmp_rbc -in /root/in.scene -log none
timed "a cell in shear from Python" inside python3 -c "import rbc
rbc.start_lammps('-log', 'none').file('/root/in.scene')"
timed "a cell in shear on 2 tasks" inside mpirun -np 2 lmp_rbc -in /root/in.scene -log none
