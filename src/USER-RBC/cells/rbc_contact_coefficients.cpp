#include "cells/rbc_contact_coefficients.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"
#include "support/rbc_arguments.h"

#include <algorithm>

using namespace LAMMPS_NS;
using rbc::ContactLaw;

ContactCoefficients::ContactCoefficients(LAMMPS *lmp) :
    Pointers(lmp), names(rbc::parameter_names<ContactLaw>()), parameters(names.size())
{
}

ContactCoefficients::~ContactCoefficients()
{
  memory->destroy(kind);
  for (double **&values : parameters) memory->destroy(values);
}

void ContactCoefficients::allocate()
{
  const int n = atom->ntypes + 1;
  memory->create(kind, n, n, "pair:kind");
  std::fill_n(kind[0], n * n, 0);
  for (double **&values : parameters) {
    memory->create(values, n, n, "pair:parameters");
    std::fill_n(values[0], n * n, 0.0);
  }
}

/* ---------------------------------------------------------------------- */

ContactCoefficients::Choice ContactCoefficients::read(int narg, char **arg, int first) const
{
  const std::string word = arg[first];
  const std::size_t law = rbc::law_index<ContactLaw>(word);
  if (law == std::variant_size_v<ContactLaw> && word != "none")
    error->all(FLERR, first, "Unknown pair_coeff rbc/jkr word {}; allowed: {}, none", word,
               rbc::law_names<ContactLaw>());

  const auto needed = rbc::law_parameters<ContactLaw>(law);
  const int given = narg - first - 1;
  if (given != static_cast<int>(needed.size())) {
    std::string list;
    for (const auto &parameter : needed)
      list += (list.empty() ? "" : " ") + std::string(parameter.name);
    error->all(FLERR, "Pair_coeff rbc/jkr {} takes {} values ({}), not {}", word, needed.size(),
               needed.empty() ? "none" : list, given);
  }

  Choice choice{law, std::vector<double>(names.size())};
  Arguments args(lmp, "pair_coeff rbc/jkr", narg, arg, first + 1);
  for (const auto &parameter : needed) {
    const std::string what = word + ' ' + parameter.name;
    choice.parameters[place_of(parameter.name)] =
        parameter.bound == rbc::Bound::positive ? args.positive(what) : args.not_negative(what);
  }
  return choice;
}

void ContactCoefficients::set(int itype, int jtype, const Choice &choice)
{
  const bool none = choice.law == std::variant_size_v<ContactLaw>;
  kind[itype][jtype] = none ? 0 : 1 + static_cast<int>(choice.law);
  for (std::size_t p = 0; p < names.size(); ++p) parameters[p][itype][jtype] = choice.parameters[p];
}

/* ---------------------------------------------------------------------- */

std::optional<ContactLaw> ContactCoefficients::law(int itype, int jtype, double length) const
{
  if (!touch(itype, jtype)) return {};
  const std::size_t law = kind[itype][jtype] - 1;
  std::vector<double> values;
  for (const auto &parameter : rbc::law_parameters<ContactLaw>(law))
    values.push_back(parameters[place_of(parameter.name)][itype][jtype] *
                     (parameter.is_length ? length : 1));
  return rbc::make_law<ContactLaw>(law, values);
}

double **ContactCoefficients::parameter(const std::string &name)
{
  const std::size_t place = place_of(name);
  return place < names.size() ? parameters[place] : nullptr;
}

std::size_t ContactCoefficients::place_of(const std::string &name) const
{
  return std::find(names.begin(), names.end(), name) - names.begin();
}

/* ----------------------------------------------------------------------
   A pair of types has in a restart file its parameters up to the last one that its law uses, and at
   least the three that the first laws had. So files stay readable when laws are added.
------------------------------------------------------------------------- */

std::size_t ContactCoefficients::restart_count(int law_kind) const
{
  std::size_t count = 3;
  for (const auto &parameter : rbc::law_parameters<ContactLaw>(law_kind - 1))
    count = std::max(count, place_of(parameter.name) + 1);
  return count;
}

void ContactCoefficients::write_restart(FILE *fp, int itype, int jtype) const
{
  std::vector<double> numbers{double(kind[itype][jtype])};
  for (std::size_t p = 0; p < restart_count(kind[itype][jtype]); ++p)
    numbers.push_back(parameters[p][itype][jtype]);
  fwrite(numbers.data(), sizeof(double), numbers.size(), fp);
}

void ContactCoefficients::read_restart(FILE *fp, int itype, int jtype)
{
  const auto read = [&](double *numbers, std::size_t count) {
    if (comm->me == 0) utils::sfread(FLERR, numbers, sizeof(double), count, fp, nullptr, error);
    MPI_Bcast(numbers, static_cast<int>(count), MPI_DOUBLE, 0, world);
  };
  double number;
  read(&number, 1);
  kind[itype][jtype] = static_cast<int>(number);
  std::vector<double> numbers(restart_count(kind[itype][jtype]));
  read(numbers.data(), numbers.size());
  for (std::size_t p = 0; p < numbers.size(); ++p) parameters[p][itype][jtype] = numbers[p];
}
