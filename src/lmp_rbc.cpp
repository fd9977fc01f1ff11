// LAMMPS with this package. LAMMPS loads the plugins in the folders of LAMMPS_PLUGIN_PATH at its
// start and after each `clear`; the folder of the plugin joins them. Scripts find templates and
// materials in LAMMPS_POTENTIALS, which is set unless the user has set it. Folders are found from
// that of this executable, so that an installation can be moved.

#include "exceptions.h"
#include "input.h"
#include "lammps.h"
#include "lammpsplugin.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <mpi.h>
#include <new>
#include <string>

using namespace LAMMPS_NS;

namespace {

/// The first of two folders, from that of this executable, that has this file; empty if none has.
std::string folder_with(const char *file, const char *built, const char *installed)
{
  const auto own = std::filesystem::canonical("/proc/self/exe").parent_path();
  for (const char *folder : {built, installed})
    if (exists(own / folder / file)) return canonical(own / folder);
  return {};
}

std::string plugin_folder()
{
  return folder_with("rbcplugin.so", ".", RBC_PLUGIN_FOLDER);
}

void set_potentials()
{
  const std::string folder =
      folder_with("healthy.material", "../potentials", RBC_POTENTIALS_FOLDER);
  if (!folder.empty()) setenv("LAMMPS_POTENTIALS", folder.c_str(), 0);
}

void add_plugin_folder()
{
  const std::string folder = plugin_folder();
  if (folder.empty()) return;
  const char *const given = std::getenv("LAMMPS_PLUGIN_PATH");
  if (given && (":" + std::string(given) + ":").find(":" + folder + ":") != std::string::npos)
    return;
  setenv("LAMMPS_PLUGIN_PATH", given ? (folder + ":" + given).c_str() : folder.c_str(), 1);
}

bool asks_for_help(int argc, char **argv)
{
  return std::any_of(argv + 1, argv + argc,
                     [](const std::string &word) { return word == "-h" || word == "-help"; });
}

void print_style(lammpsplugin_t *style, void *)
{
  std::printf("  %-8s %s\n", style->style, style->name);
}

// LAMMPS's own help lists its styles before it loads plugins, and then ends the program.

void print_styles()
{
  void *const plugin = dlopen((plugin_folder() + "/rbcplugin.so").c_str(), RTLD_NOW);
  if (!plugin) return;
  const auto init = reinterpret_cast<lammpsplugin_initfunc>(dlsym(plugin, "lammpsplugin_init"));
  std::printf("Styles of USER-RBC %s:\n", RBC_VERSION);
  if (init) init(nullptr, plugin, reinterpret_cast<void *>(print_style));
  std::printf("\nHelp of LAMMPS:\n");
  std::fflush(stdout);
}

}    // namespace

int main(int argc, char **argv)
{
  add_plugin_folder();
  set_potentials();
  MPI_Init(&argc, &argv);
  int me;
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  if (me == 0 && asks_for_help(argc, argv)) print_styles();
  try {
    LAMMPS lammps(argc, argv, MPI_COMM_WORLD);
    lammps.input->file();
  } catch (LAMMPSAbortException &abort) {
    MPI_Abort(abort.get_universe(), 1);
  } catch (LAMMPSException &) {
    // all ranks have come here together, and LAMMPS has printed why
    MPI_Finalize();
    return 1;
  } catch (std::bad_alloc &) {
    std::fprintf(stderr, "ERROR: an MPI task has not enough memory\n");
    MPI_Abort(MPI_COMM_WORLD, 1);
  } catch (std::exception &problem) {
    std::fprintf(stderr, "Exception: %s\n", problem.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Finalize();
  return 0;
}
