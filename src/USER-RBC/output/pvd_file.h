#pragma once

#include <string>

namespace rbc {

/// Name of the list that goes with a series of files, in whose names a * stands for the step:
/// out/cells.*.vtp has out/cells.pvd. Empty where the * is in the name of a folder: the files then
/// have no place in common.
std::string pvd_name(const std::string &series);

/// Adds a file, whose name is relative to the list, and its time to a list of files (.pvd), which
/// ParaView opens as one data set. Entries of that time or later are taken off: they belong to a
/// run that began anew, or that went on from an earlier restart file. Throws std::runtime_error,
/// naming the file and the reason; the list is then as before.
void add_to_pvd(const std::string &path, double time, const std::string &name);

}    // namespace rbc
