// Time of a force evaluation of one cell on one core: ns per vertex, for each law and form of
// bending.

#include "membrane/membrane_model.h"
#include "membrane/volume_gradient.h"
#include "molecule_file.h"

#include <benchmark/benchmark.h>

#include <string>

namespace {

using namespace rbc;

SurfaceTemplate red_cell(int vertices)
{
  const MoleculeFile file(POTENTIALS "/rbc_" + std::to_string(vertices) + ".mol");
  std::vector<Vec3> x;
  for (const auto &v : file.vertices) x.emplace_back(v[0], v[1], v[2]);
  return {x, file.triangles};
}

class Case {
 public:
  Case(int vertices, const MembraneParameters &parameters) :
      shape_(red_cell(vertices)), all_(CellElements::whole(shape_)), model_(shape_, parameters),
      gradient_(shape_), x_(shape_.vertices), f_(x_.size())
  {
    for (Vec3 &x : x_) x = x.cwiseProduct(Vec3(1.1, 0.95, 1.02));
  }

  template <typename Work> void time(benchmark::State &state, const Work &work)
  {
    for (auto _ : state) {
      work(*this);
      benchmark::DoNotOptimize(f_.data());
      benchmark::ClobberMemory();
    }
    const double evaluations = static_cast<double>(state.iterations()) * shape_.vertex_count();
    state.counters["vertex"] =
        benchmark::Counter(evaluations, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  }

  SurfaceTemplate shape_;
  CellElements all_;
  MembraneModel model_;
  VolumeGradient gradient_;
  std::vector<Vec3> x_, f_;
};

template <typename Work>
void add(const std::string &name, const MembraneParameters &parameters, const Work &work)
{
  for (int vertices : {642, 2562})
    benchmark::RegisterBenchmark(
        (name + '/' + std::to_string(vertices)).c_str(),
        [=](benchmark::State &state) { Case(vertices, parameters).time(state, work); });
}

void add_all()
{
  const auto forces = [](Case &c) {
    c.model_.set_cell(c.all_, c.x_);
    benchmark::DoNotOptimize(c.model_.forces({}, c.f_));
  };
  const std::pair<const char *, SheetLaw> laws[] = {
      {"mooney-rivlin", MooneyRivlin(0.257, 0.0257, 0.01)},
      {"neo-hookean", NeoHookean(5e-3)},
      {"skalak", Skalak(5e-3, 50)}};
  for (const auto &[name, law] : laws) {
    MembraneParameters parameters;
    parameters.law = law;
    add(std::string(name) + "/none", parameters, forces);
    parameters.bending = 2e-4;
    for (BendingForm form : {BendingForm::dihedral, BendingForm::helfrich}) {
      parameters.bending_form = form;
      add(std::string(name) + (form == BendingForm::dihedral ? "/dihedral" : "/helfrich"),
          parameters, forces);
    }
  }
  add("geometry/alone", {}, [](Case &c) { c.model_.set_cell(c.all_, c.x_); });
  add("flaw/alone", {}, [](Case &c) {
    c.model_.set_cell(c.all_, c.x_);
    benchmark::DoNotOptimize(c.model_.find_flaw());
  });
  add("volume/gradient", {}, [](Case &c) {
    benchmark::DoNotOptimize(c.gradient_.find(c.all_, c.x_.data(), c.f_.data()));
  });
}

}    // namespace

int main(int argc, char **argv)
{
  benchmark::Initialize(&argc, argv);
  add_all();
  benchmark::RunSpecifiedBenchmarks();
}
