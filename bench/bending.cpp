// Error of both forms of bending over the spacing of the mesh, in CSV: energies of a sphere and of
// the biconcave disc, normal force per area on the disc.

#include "disc_force.h"

#include <cstdio>

using namespace test;

int main()
{
  const double disc_energy = 1.928922 * 8 * pi;        // of the disc of equation (1) of the paper
  const Profile tabulated{0.2072, 2.0026, -1.1228};    // where the force is tabulated
  std::printf("form,frequency,vertices,spacing,sphere_energy,disc_energy,force_bands,force_median,"
              "force_rms,"
              "force_largest,force_rms_everywhere,force_exact\n");
  for (rbc::BendingForm form : {rbc::BendingForm::helfrich, rbc::BendingForm::dihedral})
    for (int frequency : {4, 8, 16, 32, 64}) {
      rbc::MembraneParameters parameters;
      parameters.law = rbc::Skalak(0, 0);
      parameters.bending = 1;
      parameters.bending_form = form;
      parameters.reference_curvature = false;
      const Mesh sphere = icosphere(frequency), cell = disc(frequency);
      const auto energy = [&](const Mesh &mesh) {
        return evaluate(mesh.surface(), parameters, mesh.vertices).energy.bending;
      };
      // Equilateral triangles have a Gaussian modulus of -4/3 kappa in the dihedral form.
      const double gaussian = form == rbc::BendingForm::dihedral ? -16 * pi / 3 : 0;
      const DiscForceError force(frequency, tabulated, parameters);
      std::printf("%s,%d,%zu,%.5g,%.6g,%.6g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g\n",
                  form == rbc::BendingForm::helfrich ? "helfrich" : "dihedral", frequency,
                  cell.vertices.size(), cell.surface().mean_edge,
                  energy(sphere) / (8 * pi + gaussian) - 1,
                  energy(cell) / (disc_energy + gaussian) - 1, force.bands, force.median, force.rms,
                  force.largest, force.rms_everywhere, force.exact);
    }
}
