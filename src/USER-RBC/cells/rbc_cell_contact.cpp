#include "cells/rbc_cell_contact.h"

#include "fix.h"
#include "force.h"
#include "modify.h"
#include "pair.h"
#include "support/rbc_pair_parts.h"

#include <algorithm>

using namespace LAMMPS_NS;

std::vector<CellContact *> LAMMPS_NS::find_cell_contacts(Force *force)
{
  std::vector<CellContact *> contacts;
  for (StepPart *part : pair_step_parts(force)) {
    const auto *const pair = dynamic_cast<Pair *>(part);
    auto *const contact = dynamic_cast<CellContact *>(part);
    if (contact && pair && pair->compute_flag && force->pair->compute_flag)
      contacts.push_back(contact);
  }
  return contacts;
}

CellContact *LAMMPS_NS::find_cell_contact(Force *force)
{
  const std::vector<CellContact *> contacts = find_cell_contacts(force);
  const auto most = std::max_element(
      contacts.begin(), contacts.end(),
      [](const CellContact *a, const CellContact *b) { return a->own_gap() < b->own_gap(); });
  return most == contacts.end() ? nullptr : *most;
}

double LAMMPS_NS::widest_gap_wanted(Modify *modify)
{
  double widest = 0;
  const std::vector<Fix *> fixes = modify->get_fix_list();    // readers ask for the list, too
  for (Fix *fix : fixes)
    if (const auto *const reader = dynamic_cast<ContactReader *>(fix))
      widest = std::max(widest, reader->widest_gap());
  return widest;
}
