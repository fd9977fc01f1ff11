#include "cells/rbc_cell_places.h"

#include "comm.h"
#include "error.h"
#include "fmt/format.h"
#include "lammps.h"
#include "math_const.h"
#include "tokenizer.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <mpi.h>
#include <utility>

using namespace LAMMPS_NS;
using Eigen::AngleAxisd;
using rbc::Vec3;

/* ---------------------------------------------------------------------- */

Eigen::Matrix3d LAMMPS_NS::rotation_about(double degrees, const Vec3 &axis)
{
  return AngleAxisd(degrees * MathConst::DEG2RAD, axis.normalized()).toRotationMatrix();
}

Eigen::Matrix3d LAMMPS_NS::hemocell_rotation(double rx, double ry, double rz)
{
  constexpr double TO_ITS_AXIS = 90;
  return rotation_about(rz, Vec3::UnitZ()) * rotation_about(ry, Vec3::UnitY()) *
         rotation_about(rx + TO_ITS_AXIS, Vec3::UnitX());
}

namespace {

/// Reads places line by line, as numbers that rank 0 can send.
class PlaceReader {
 public:
  static constexpr int NUMBERS = 13;    ///< of a place: origin, rotation, line

  explicit PlaceReader(PlaceForm form) : form_(form) {}

  /// Adds the place in a line, if there is one; returns what is wrong with it.
  std::string add(const std::string &line, int number)
  {
    words_ = Tokenizer(line.substr(0, line.find('#'))).as_vector();
    if (words_.empty()) return "";
    const bool first = std::exchange(first_, false);
    std::vector<double> given;
    for (const std::string &word : words_) {
      given.push_back(std::strtod(word.c_str(), nullptr));
      if (!utils::is_double(word) || !std::isfinite(given.back()))
        return fmt::format("has {} where a number is wanted", word);
    }
    if (form_ == PlaceForm::axis) return add_by_axis(given, number, first);
    return first ? set_count(given) : add_of_hemocell(given, number);
  }

  /// What is wrong with the file as a whole.
  std::string problem() const
  {
    const std::size_t found = numbers.size() / NUMBERS;
    if (found == 0) return "holds no places of cells";
    if (form_ == PlaceForm::axis || found == count_) return "";
    return fmt::format("says in its first line that there are {} cells, but has places of {}",
                       count_, found);
  }

  std::vector<double> numbers;

 private:
  PlaceForm form_;
  bool first_ = true;
  std::size_t count_ = 0;
  std::vector<std::string> words_;

  std::string wrong_count(const std::string &allowed) const
  {
    return fmt::format("has {} word{}; {}", words_.size(), words_.size() == 1 ? "" : "s", allowed);
  }

  std::string add_by_axis(const std::vector<double> &given, int number, bool first)
  {
    if (given.size() == 1 && first)
      return "has 1 number (a HemoCell .pos file begins so: use hemocell in place of file); "
             "x y z or x y z theta nx ny nz are allowed";
    if (given.size() != 3 && given.size() != 7)
      return wrong_count("x y z or x y z theta nx ny nz are allowed");
    if (given.size() == 3) {
      store(given, Eigen::Matrix3d::Identity(), number);
      return "";
    }
    const Vec3 axis(&given[4]);
    if (axis.isZero(0)) return "has an axis nx ny nz of length 0";
    store(given, rotation_about(given[3], axis), number);
    return "";
  }

  std::string set_count(const std::vector<double> &given)
  {
    if (given.size() != 1 || !utils::is_integer(words_[0]) || given[0] < 0)
      return "must hold one number alone, that of cells";
    count_ = static_cast<std::size_t>(given[0]);
    return "";
  }

  std::string add_of_hemocell(const std::vector<double> &given, int number)
  {
    if (given.size() != 6) return wrong_count("x y z rx ry rz are wanted");
    store(given, hemocell_rotation(given[3], given[4], given[5]), number);
    return "";
  }

  void store(const std::vector<double> &given, const Eigen::Matrix3d &rotation, int number)
  {
    numbers.insert(numbers.end(), given.begin(), given.begin() + 3);
    numbers.insert(numbers.end(), rotation.data(), rotation.data() + rotation.size());
    numbers.push_back(number);
  }
};

}    // namespace

/* ---------------------------------------------------------------------- */

std::vector<CellPlace> LAMMPS_NS::read_cell_places(LAMMPS *lmp, const std::string &file,
                                                   PlaceForm form, const std::string &style)
{
  PlaceReader reader(form);
  if (lmp->comm->me == 0) {
    std::ifstream stream(file);
    if (!stream)
      lmp->error->one(FLERR, "{}: cannot open {}: {}", style, file, utils::getsyserror());
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
      const std::string problem = reader.add(line, number);
      if (!problem.empty())
        lmp->error->one(FLERR, "{}: line {} of {} {}", style, number, file, problem);
    }
    const std::string problem = reader.problem();
    if (!problem.empty()) lmp->error->one(FLERR, "{}: {} {}", style, file, problem);
  }
  std::vector<double> &numbers = reader.numbers;
  bigint size = static_cast<bigint>(numbers.size());
  MPI_Bcast(&size, 1, MPI_LMP_BIGINT, 0, lmp->world);
  numbers.resize(size);
  MPI_Bcast(numbers.data(), static_cast<int>(size), MPI_DOUBLE, 0, lmp->world);

  std::vector<CellPlace> places;
  for (std::size_t n = 0; n < numbers.size(); n += PlaceReader::NUMBERS) {
    const double *const place = &numbers[n];
    places.push_back({Vec3(place), Eigen::Matrix3d(Eigen::Map<const Eigen::Matrix3d>(place + 3)),
                      static_cast<int>(place[PlaceReader::NUMBERS - 1])});
  }
  return places;
}
