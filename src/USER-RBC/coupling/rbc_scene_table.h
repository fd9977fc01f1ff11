#ifndef LMP_RBC_SCENE_TABLE_H
#define LMP_RBC_SCENE_TABLE_H

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class CellMembranes;
class DrivenFlow;

/// What a scene of cells is made of, measured by the fluid's grid: a table at the start of a run,
/// and a warning for each number that is out of its range. A run whose table is that of the one
/// before prints nothing. The version of the package stands above the first table.
class SceneTable : protected Pointers {
 public:
  /// `style` names the fix of the fluid in warnings.
  SceneTable(LAMMPS *lmp, std::string style);

  void choose_warnings(bool on) { warns_ = on; }

  /// Collective, at the start of a run, when all styles are initialised and the forcing of the flow
  /// is known. Prints no table of a scene without cells.
  void print(const DrivenFlow &flow);

 private:
  /// The cells of one fix rbc/membrane; lengths in the units of the input script.
  struct Kind {
    CellMembranes *membranes;
    double cells, capillary_number;
    std::vector<int> types;    ///< of its atoms; all types as long as it has none
    double contact = 0;        ///< shortest range to any cell, 0 if it does not touch some
    double adhesion = 0;       ///< largest energy per area to any cell
  };

  std::string style_, printed_;
  bool warns_ = true, version_printed_ = false;
  double spacing_ = 1, shear_rate_ = 0, plate_distance_ = 0;
  std::vector<Kind> kinds_;
  std::vector<std::string> apart_;    ///< cells that do not touch each other, in words
  std::string repelling_;             ///< pair styles and fixes that repel cells from walls

  void print_version();
  double shear_rate(const DrivenFlow &flow) const;
  void find_kinds(const DrivenFlow &flow);
  void find_types();
  void find_contacts();
  void find_repelling();
  std::string repelling_pairs() const;
  double adhesion(const Kind &kind) const;
  std::string rate() const;
  double plate_distance() const;
  double contact_range(const Kind &one, const Kind &other) const;
  double contact_range(int itype, int jtype) const;
  double cells() const;
  std::string table(const DrivenFlow &flow) const;
  std::string boundaries(const DrivenFlow &flow) const;
  void warn_of_edges() const;
  void warn_of_insides(const DrivenFlow &flow) const;
  void warn_of_contacts() const;
  void warn_of_units(const DrivenFlow &flow) const;
  void warn_of_plates(const DrivenFlow &flow) const;
};

}    // namespace LAMMPS_NS

#endif
