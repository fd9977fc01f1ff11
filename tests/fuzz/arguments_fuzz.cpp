// Arguments of each style, in a LAMMPS of its own each time. The first letter chooses the style,
// the rest of the line are its arguments. They must be taken, or refused with an error of LAMMPS.

#include "exceptions.h"
#include "input.h"
#include "lammps.h"
#include "lammpsplugin.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <initializer_list>
#include <mpi.h>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc);
namespace LAMMPS_NS {
void plugin_register(lammpsplugin_t *plugin, void *lmp);
}

namespace {

// an octahedron: the fewer triangles, the more lines are tried
constexpr const char *TEMPLATE = R"(# a cell

6 atoms
8 angles

Coords

1 1 0 0
2 -1 0 0
3 0 1 0
4 0 -1 0
5 0 0 1
6 0 0 -1

Angles

1 1 1 3 5
2 1 3 2 5
3 1 2 4 5
4 1 4 1 5
5 1 3 1 6
6 1 2 3 6
7 1 4 2 6
8 1 1 4 6
)";

/// A file in memory, which LAMMPS opens by its name.
std::string template_file()
{
  const std::size_t size = std::strlen(TEMPLATE);
  const int descriptor = memfd_create("template", 0);
  if (descriptor < 0 || write(descriptor, TEMPLATE, size) != static_cast<ssize_t>(size))
    std::abort();
  return "/proc/self/fd/" + std::to_string(descriptor);
}

constexpr std::array SCENE = {
    "units micro",
    "atom_style molecular",
    "region box block 0 12 0 12 0 12",
    "create_box 2 box angle/types 1",
    "mass * 1",
    "region ball sphere 6 6 6 4",
    "variable v equal 1",
    "group wall type 2",
    "neighbor 1 bin",
};

constexpr std::array FIXES = {
    "rbc/create rbc single 6 6 6",
    "fix flow all rbc/fluid dx 1 viscosity 1 density 1",
    "fix membrane all rbc/membrane rbc skalak 1 1",
    "fix ib all rbc/ib flow",
    "compute agg all rbc/aggregate 0.5",
    "pair_style rbc/jkr 0.5",
};

constexpr std::array STYLES = {
    "fix f all rbc/fluid ",
    "fix i all rbc/ib ",
    "fix m all rbc/membrane ",
    "fix w wall rbc/wall ",
    "fix v all rbc/vtk ",
    "compute c all rbc/cell ",
    "compute a all rbc/aggregate ",
    "region r rbc/mesh ",
    "rbc/create ",
    "rbc/surface ",
    "pair_style rbc/jkr ",
    "pair_coeff ",
    "fix_modify ",
};

/// One line of an input script: no variables are put in, and nothing is read from elsewhere.
std::string line_of(const std::uint8_t *data, std::size_t size)
{
  std::string line = STYLES[data[0] % STYLES.size()];
  for (std::size_t n = 1; n < size; ++n) {
    const char letter = static_cast<char>(data[n]);
    line += letter == '\n' || letter == '\0' || letter == '$' ? ' ' : letter;
  }
  return line;
}

/// Commands do as much as they are told to: large numbers would only take time.
bool takes_long(const std::string &line)
{
  if (line.compare(0, 4, "rbc/") != 0) return false;
  int digits = 0;
  for (const char letter : line) {
    const bool digit = letter >= '0' && letter <= '9';
    if (digits > 0 && (letter == 'e' || letter == 'E')) return true;
    digits = digit ? digits + 1 : 0;
    if (digits > 2) return true;
  }
  return false;
}

void run(LAMMPS_NS::LAMMPS &lammps, std::initializer_list<std::string> lines)
{
  for (const std::string &line : lines) lammps.input->one(line);
}

}    // namespace

extern "C" int LLVMFuzzerInitialize(int *argc, char ***argv)
{
  MPI_Init(argc, argv);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  if (size == 0 || size > 300) return 0;
  const std::string line = line_of(data, size);
  if (takes_long(line)) return 0;

  const char *words[] = {"fuzz", "-log", "none", "-screen", "none", "-nocite"};
  LAMMPS_NS::LAMMPS lammps(6, const_cast<char **>(words), MPI_COMM_WORLD);
  static void *const self = dlopen(nullptr, RTLD_LAZY);
  lammpsplugin_init(&lammps, self, reinterpret_cast<void *>(&LAMMPS_NS::plugin_register));
  for (const char *command : SCENE) run(lammps, {command});
  static const std::string file = template_file();
  run(lammps, {"molecule rbc " + file});
  for (const char *command : FIXES) run(lammps, {command});
  try {
    run(lammps, {line});
  } catch (const LAMMPS_NS::LAMMPSException &) {
    // refused, with a message
  }
  return 0;
}
