// LAMMPS with this package. LAMMPS loads the plugins in the folders of LAMMPS_PLUGIN_PATH at its start and after each
// `clear`; the folder of this executable, where the plugin is, joins them.

#include "exceptions.h"
#include "input.h"
#include "lammps.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <mpi.h>
#include <new>
#include <string>

using namespace LAMMPS_NS;

namespace {

void add_plugin_folder()
{
  const std::string folder = std::filesystem::canonical("/proc/self/exe").parent_path();
  const char *const given = std::getenv("LAMMPS_PLUGIN_PATH");
  if (given && (":" + std::string(given) + ":").find(":" + folder + ":") != std::string::npos)
    return;
  setenv("LAMMPS_PLUGIN_PATH", given ? (folder + ":" + given).c_str() : folder.c_str(), 1);
}

}    // namespace

int main(int argc, char **argv)
{
  add_plugin_folder();
  MPI_Init(&argc, &argv);
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
