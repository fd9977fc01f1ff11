#include "cells/rbc_cell_places.h"

#include "comm.h"
#include "error.h"
#include "fmt/format.h"
#include "lammps.h"
#include "math_const.h"
#include "tokenizer.h"

#include <Eigen/Geometry>

#include <cmath>
#include <fstream>
#include <mpi.h>

using namespace LAMMPS_NS;
using rbc::Vec3;

static constexpr int NUMBERS = 8;    // of a place: those of its line, and which it is

/* ---------------------------------------------------------------------- */

Eigen::Matrix3d LAMMPS_NS::rotation_about(double degrees, const Vec3 &axis)
{
  return Eigen::AngleAxisd(degrees * MathConst::DEG2RAD, axis.normalized()).toRotationMatrix();
}

/* ----------------------------------------------------------------------
   adds the place in a line, if there is one; returns what is wrong with it
------------------------------------------------------------------------- */

static std::string add_place(const std::string &line, int number, std::vector<double> &places)
{
  const std::vector<std::string> words = Tokenizer(line.substr(0, line.find('#'))).as_vector();
  if (words.empty()) return "";
  if (words.size() != 3 && words.size() != 7)
    return fmt::format("has {} words; x y z or x y z theta nx ny nz are allowed", words.size());
  double place[NUMBERS] = {0, 0, 0, 0, 0, 0, 1, double(number)};
  for (std::size_t n = 0; n < words.size(); ++n) {
    if (!utils::is_double(words[n]) || !std::isfinite(place[n] = std::stod(words[n])))
      return fmt::format("has {} where a number is wanted", words[n]);
  }
  if (place[4] == 0 && place[5] == 0 && place[6] == 0) return "has an axis nx ny nz of length 0";
  places.insert(places.end(), place, place + NUMBERS);
  return "";
}

/* ---------------------------------------------------------------------- */

std::vector<CellPlace> LAMMPS_NS::read_cell_places(LAMMPS *lmp, const std::string &file,
                                                   const std::string &style)
{
  std::vector<double> numbers;
  if (lmp->comm->me == 0) {
    std::ifstream stream(file);
    if (!stream)
      lmp->error->one(FLERR, "{}: cannot open {}: {}", style, file, utils::getsyserror());
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
      const std::string problem = add_place(line, number, numbers);
      if (!problem.empty())
        lmp->error->one(FLERR, "{}: line {} of {} {}", style, number, file, problem);
    }
    if (numbers.empty()) lmp->error->one(FLERR, "{}: {} holds no places of cells", style, file);
  }
  bigint size = static_cast<bigint>(numbers.size());
  MPI_Bcast(&size, 1, MPI_LMP_BIGINT, 0, lmp->world);
  numbers.resize(size);
  MPI_Bcast(numbers.data(), static_cast<int>(size), MPI_DOUBLE, 0, lmp->world);

  std::vector<CellPlace> places;
  for (std::size_t n = 0; n < numbers.size(); n += NUMBERS) {
    const double *const place = &numbers[n];
    places.push_back({Vec3(place), rotation_about(place[3], Vec3(place + 4)),
                      static_cast<int>(place[NUMBERS - 1])});
  }
  return places;
}
