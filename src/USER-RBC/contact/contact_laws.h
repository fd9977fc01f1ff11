#pragma once

#include "contact/hertz_contact.h"
#include "contact/jkr_contact.h"

#include <variant>

namespace rbc {

/// The table of all contact laws. A new law needs its header and its place at the end of this list;
/// pair rbc/jkr finds it by its word and writes its place into restart files (see law_table.h).
///
/// Two surfaces a gap apart overlap by tip_radius() - gap. Each law has
///   tip_radius()             gap at which the overlap is zero; force() must be defined up to there
///   detachment_overlap()     where contact is lost, at most zero; beyond it there is no force
///   equilibrium_overlap()    where the force vanishes
///   work_per_area()          work to separate surfaces from there, energy per area
///   largest_adhesion()       largest attraction, force per area
///   limit()                  what the parameters must satisfy so that surfaces at equilibrium do
///                            not overlap, in words for an error message
///   force(h), energy(h)      of a single tip against a flat, for pair_write
///   per_area(h)              the same per area of a surface covered by tips
/// The last three may be asked for an overlap above detachment_overlap() only. Forces are positive
/// where they repel; an energy is the integral of the force over the overlap, 0 at detachment.
/// Parameters are known by their names: a name that two laws share is one parameter of a pair of
/// types in restart files and for fix adapt.
using ContactLaw = std::variant<JkrContact, HertzContact>;

}    // namespace rbc
