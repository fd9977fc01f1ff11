#include "support/rbc_molecule_shares.h"

#include "comm.h"
#include "support/rbc_gather.h"

#include <mpi.h>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   Each rank names one of its molecules, the next further along its own: together they are spread as
   the molecules are.
------------------------------------------------------------------------- */

void MoleculeShares::divide(const std::vector<tagint> &mine)
{
  lowest_.clear();
  if (comm->nprocs == 1) return;
  std::vector<tagint> named;
  if (!mine.empty()) named.push_back(mine[mine.size() * comm->me / comm->nprocs]);
  lowest_ = gather_all(named, world);
  std::sort(lowest_.begin(), lowest_.end());
}

int MoleculeShares::rank_of(tagint molecule) const
{
  const auto next = std::upper_bound(lowest_.begin(), lowest_.end(), molecule);
  return std::max(0, static_cast<int>(next - lowest_.begin()) - 1);
}

std::vector<MoleculeShares::Request> MoleculeShares::ask(const std::vector<tagint> &molecules) const
{
  std::vector<Request> requests;
  requests.reserve(molecules.size());
  for (tagint molecule : molecules) requests.push_back({molecule, comm->me});
  return send(std::move(requests));
}

/* ----------------------------------------------------------------------
   MPI_Exscan leaves what rank 0 has undefined
------------------------------------------------------------------------- */

bigint LAMMPS_NS::count_before(LAMMPS *lmp, std::size_t here)
{
  const auto count = static_cast<bigint>(here);
  bigint before = 0;
  MPI_Exscan(&count, &before, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  return lmp->comm->me == 0 ? 0 : before;
}

/* ---------------------------------------------------------------------- */

std::vector<MoleculePlace> LAMMPS_NS::places_in_order(LAMMPS *lmp, std::vector<tagint> molecules)
{
  using Request = MoleculeShares::Request;
  std::sort(molecules.begin(), molecules.end());
  MoleculeShares shares(lmp);
  shares.divide(molecules);
  std::vector<Request> requests = shares.ask(molecules);
  std::sort(requests.begin(), requests.end(),
            [](const Request &a, const Request &b) { return a.molecule < b.molecule; });

  auto place = static_cast<int>(count_before(lmp, requests.size()));
  std::vector<MoleculePlace> places;
  std::vector<int> ranks;
  for (const auto &[molecule, rank] : requests) {
    places.push_back({molecule, place++});
    ranks.push_back(rank);
  }
  return send_elements(lmp, std::move(places), std::move(ranks));
}
