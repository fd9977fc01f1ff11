# Shared by the scripts that try things in a new, minimal Debian, which lies below a temporary
# folder and goes when they end. Sourced after common.sh, as root.
[ "$(id -u)" = 0 ] || fail "a new Debian can only be made as root"
"$ROOT/scripts/dependencies.sh" debootstrap

debian=''
remove_debian() {
  [ -n "$debian" ] || return 0
  umount "$debian/proc" "$debian/dev" 2>/dev/null || true
  rm -rf --one-file-system "$debian" "$debian.log" "$debian.time"
  debian=''
}
trap remove_debian EXIT
trap 'exit 1' HUP INT TERM

# timed <what> <command ...>: runs it, with its output in a file that is shown where it fails, and
# says how long it took by the clock and in time of a core.
timed() {
  local wall user system cores TIMEFORMAT='%R %U %S'
  { time "${@:2}" >"$debian.log" 2>&1; } 2>"$debian.time" || fail "$1: $(tail -n 20 "$debian.log")"
  read -r wall user system <"$debian.time"
  cores=$(plus "$user" "$system")
  say_times "$1" "$wall" "$cores"
  sum=$(plus "$sum" "$wall") sum_cores=$(plus "$sum_cores" "$cores")
}
say_times() { say "$(printf '%s: %.0f s, %.0f s of a core' "$@")"; }
plus() { awk "BEGIN {print $1 + $2}"; }

# Of all that was timed since.
start_sum() { sum=0 sum_cores=0; }
say_sum() { say_times "$1" "$sum" "$sum_cores"; }
start_sum

# as common.sh has them
mapfile -t variables < <(env | grep -E '^(OMPI_|PRTE_|HWLOC_|USER_RBC_JOBS=)')

inside() {
  chroot "$debian" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive "${variables[@]}" "$@"
}

# new_debian <suite>: takes over whether apt checks the dates of an archive, for mirrors of a day.
new_debian() {
  debian=$(mktemp -d)
  timed "new Debian, $1" debootstrap --variant=minbase "$1" "$debian" "$(debian_archive)"
  apt-config dump | grep '^Acquire::Check-' >"$debian/etc/apt/apt.conf.d/50dates" || true
  mount -t proc proc "$debian/proc"
  mount --bind /dev "$debian/dev"
}
