"""Plasma in a network of twenty tubes between four ports: its flows are those of the tubes'
resistances, and nothing gets lost where tubes meet."""

import unittest

import numpy as np

from lammps_case import ROOT
from scene_case import run_example, study_of


class Network(unittest.TestCase):
    def test_flows_in_the_tubes(self):
        study = study_of("network")
        result = run_example("network", 2, dx=1.5, edge=1.2, tables=study.HERE,
                             scripts=ROOT / "scripts")
        network, last = study.the_network(), result.thermo
        flows = study.measured(network, study.read_grid(result.path("flow.0.vtr"))) / study.FLOW
        laws = study.poiseuille(network) / study.FLOW
        lost = study.imbalance(network, flows * study.FLOW)
        away = np.sqrt(((flows - laws)**2).mean())
        print(f"\nflows: {away:.2%} of the inlet's away from resistances, at most "
              f"{abs(flows - laws).max():.2%}; lost in a node {lost:.2%}")
        self.assertLess(last["f_flow[11]"][0], 1e-13)
        # tubes of 7 to 11 cells: walls are blurred, and resistances are those of tubes as long as
        # from node to node
        self.assertLess(away, 0.02)
        self.assertLess(abs(flows - laws).max(), 0.03)
        self.assertLess(lost, 0.03)
        ports = [last[f"f_{name}[1]"][0] / study.FLOW for name in (study.INLET, *study.OUTLETS)]
        self.assertAlmostEqual(sum(ports), 0, delta=2e-8)    # the log has eight digits
        ends = [np.flatnonzero(network.segments == network.names.index(name))[0] // 2
                for name in (study.INLET, *study.OUTLETS)]
        np.testing.assert_allclose(np.abs(ports), flows[ends], atol=0.02)


if __name__ == "__main__":
    unittest.main()
