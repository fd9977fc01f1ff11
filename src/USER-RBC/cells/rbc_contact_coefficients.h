#ifndef LMP_RBC_CONTACT_COEFFICIENTS_H
#define LMP_RBC_CONTACT_COEFFICIENTS_H

#include "contact/contact_laws.h"
#include "pointers.h"

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Contact laws between types of atoms: what pair_coeff sets, fix adapt changes and restart files
/// hold. Only the entries i, j with i <= j are in use.
class ContactCoefficients : protected Pointers {
 public:
  /// A law as pair_coeff names it.
  struct Choice {
    std::size_t law;                   ///< its place in the table of laws; its end for none
    std::vector<double> parameters;    ///< one for each parameter of any law of the table
  };

  explicit ContactCoefficients(LAMMPS *);
  ~ContactCoefficients() override;

  /// Makes room for all pairs of types. No types touch yet.
  void allocate();

  /// Reads a law's word and its values from `arg` at `first` on. A word or value that is not
  /// allowed is an error; collective.
  Choice read(int narg, char **arg, int first) const;

  void set(int itype, int jtype, const Choice &);

  bool touch(int itype, int jtype) const { return kind[itype][jtype] != 0; }

  /// The law of two types with its present parameters, whose lengths are in units of `length`; none
  /// if they do not touch.
  std::optional<rbc::ContactLaw> law(int itype, int jtype, double length) const;

  /// Values of a parameter over pairs of types; nullptr if no law has one of that name.
  double **parameter(const std::string &name);

  /// Writes the entry of two types; rank 0 only.
  void write_restart(FILE *, int itype, int jtype) const;

  /// Reads the entry of two types on rank 0, the only one that needs the file; collective.
  void read_restart(FILE *, int itype, int jtype);

 private:
  std::vector<std::string> names;       // of the parameters of all laws
  std::vector<double **> parameters;    // values of each of these, 0 where the law has none such
  int **kind = nullptr;                 // 0 for none, else 1 + place of the law in the table

  std::size_t place_of(const std::string &name) const;
  std::size_t restart_count(int law_kind) const;
};

}    // namespace LAMMPS_NS

#endif
