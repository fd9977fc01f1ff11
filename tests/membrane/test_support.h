#pragma once

#include "../geometry/test_support.h"
#include "membrane/membrane_model.h"
#include "membrane/volume_gradient.h"

namespace test {

// ---- a model and what it gives for a whole cell

struct Result {
  rbc::AreaVolume size;
  rbc::MembraneEnergy energy;
  Vertices force, volume_gradient;
};

inline Result evaluate(rbc::MembraneModel &model, const rbc::SurfaceTemplate &shape,
                       const Vertices &x)
{
  const auto all = rbc::CellElements::whole(shape);
  Result result;
  result.force.resize(x.size());
  result.volume_gradient.resize(x.size());
  model.set_cell(all, x);
  result.size = model.area_and_volume();
  rbc::VolumeGradient(shape).find(all, x.data(), result.volume_gradient.data());
  result.energy = model.forces(result.size, result.force);
  return result;
}

inline Result evaluate(const rbc::SurfaceTemplate &shape, const rbc::MembraneParameters &parameters,
                       const Vertices &x)
{
  rbc::MembraneModel model(shape, parameters);
  return evaluate(model, shape, x);
}

/// Each energy of a membrane by itself, with moduli of order one, and all of them together.
inline std::map<std::string, rbc::MembraneParameters> each_energy()
{
  rbc::MembraneParameters nothing;
  nothing.law = rbc::Skalak(0, 0);
  std::map<std::string, rbc::MembraneParameters> sets;
  const auto add = [&](const std::string &name) -> rbc::MembraneParameters & {
    return sets[name] = nothing;
  };
  add("neo-Hookean").law = rbc::NeoHookean(1.3);
  add("Mooney-Rivlin").law = rbc::MooneyRivlin(40, 25, 0.01);
  add("Skalak").law = rbc::Skalak(0.8, 5);
  add("bending, reference").bending = 0.3;
  rbc::MembraneParameters &flat = add("bending, c0 = 0");
  flat.bending = 0.3;
  flat.reference_curvature = false;
  rbc::MembraneParameters &curved = add("bending, c0 = -1.7");
  curved = flat;
  curved.spontaneous_curvature = -1.7;
  for (const char *name : {"bending, reference", "bending, c0 = 0", "bending, c0 = -1.7"})
    (add(std::string(name) + ", dihedral") = sets.at(name)).bending_form =
        rbc::BendingForm::dihedral;
  for (const char *name : {"bending, c0 = 0", "bending, c0 = 0, dihedral"}) {
    rbc::MembraneParameters &creased = add(std::string(name) + ", crease");
    creased = sets.at(name);
    creased.crease = {0.2, 1};    // no edge near the angle at which it sets in
  }
  rbc::MembraneParameters &stretched = add("stretch");
  stretched.reference_curvature = false;
  stretched.stretch = {0.3, 0};    // sets in everywhere
  add("local area").local_area = 4;
  add("global area").global_area = 4;
  add("volume").volume = 6;
  rbc::MembraneParameters &all = add("all");
  all = curved;
  all.law = rbc::MooneyRivlin(40, 25, 0.01);
  all.local_area = all.global_area = 2;
  all.volume = 3;
  return sets;
}

inline std::vector<std::string> names_of_energies()
{
  std::vector<std::string> names;
  for (const auto &set : each_energy()) names.push_back(set.first);
  return names;
}

inline std::string test_name(const testing::TestParamInfo<std::string> &info)
{
  std::string name;
  for (char c : info.param)
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  return name;
}

}    // namespace test
