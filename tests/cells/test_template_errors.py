"""What molecule templates that are no closed surface get."""

import unittest

import numpy as np

from error_case import BadInput
from lammps_case import attempt, scene

OCTAHEDRON = [(1, 3, 5), (3, 2, 5), (2, 4, 5), (4, 1, 5), (3, 1, 6), (2, 3, 6), (4, 2, 6),
              (1, 4, 6)]
CORNERS = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]


def molecule(corners, triangles):
    lines = ["# made by test_template_errors.py", "", f"{len(corners)} atoms",
             f"{len(triangles)} angles" if triangles else "", "", "Coords", ""]
    lines += [f"{n} {x} {y} {z}" for n, (x, y, z) in enumerate(corners, 1)]
    lines += ["", "Types", ""] + [f"{n} 1" for n in range(1, len(corners) + 1)]
    if triangles:
        lines += ["", "Angles", ""] + [f"{n} 1 {i} {j} {k}"
                                       for n, (i, j, k) in enumerate(triangles, 1)]
    return "\n".join(lines) + "\n"


def shifted(triangles, by):
    return [tuple(v + by for v in triangle) for triangle in triangles]


# of the octahedron: vertices, triangles, words of the message

TEMPLATES = {
    "open": (CORNERS, OCTAHEDRON[:-1], ["edge", "one triangle only", "not closed"]),
    "inward": (CORNERS, [(i, k, j) for i, j, k in OCTAHEDRON], ["oriented inward"]),
    "one triangle turned": (CORNERS, [(3, 1, 5)] + OCTAHEDRON[1:],
                            ["edge", "same direction", "not consistently"]),
    "two pieces": (CORNERS + [(x + 5, y, z) for x, y, z in CORNERS],
                   OCTAHEDRON + shifted(OCTAHEDRON, 6),
                   ["more than one piece"]),
    "unused vertex": (CORNERS + [(5, 5, 5)], OCTAHEDRON, ["vertex 7", "no triangle"]),
    "flat triangle": ([(1, 0, 0)] * 1 + [(-1, 0, 0), (1, 0, 0)] + CORNERS[3:], OCTAHEDRON,
                      ["triangle", "no area"]),
    "pinched": (CORNERS + [(2 * x, 2 * y, 0) for x, y, _ in CORNERS[:4]],
                OCTAHEDRON +
                [tuple(v if v > 4 else v + 6 for v in triangle) for triangle in OCTAHEDRON],
                ["touches itself", "vertex 5"]),
    "three triangles": (CORNERS[:5], OCTAHEDRON[:3], ["at least 4 triangles"]),
    "no triangles": (CORNERS, [], ["no Angles"]),
}


def torus(n=4, m=4):
    """n by m quadrilaterals, oriented outward."""
    corners, triangles = [], []
    for i in range(n):
        for j in range(m):
            a, b = 2 * np.pi * i / n, 2 * np.pi * j / m
            corners.append(((3 + np.cos(b)) * np.cos(a), (3 + np.cos(b)) * np.sin(a), np.sin(b)))
            p, q = (i + 1) % n, (j + 1) % m
            triangles += [(i * m + j + 1, p * m + j + 1, p * m + q + 1),
                          (i * m + j + 1, p * m + q + 1, i * m + q + 1)]
    return corners, triangles


class Templates(BadInput):
    def test_templates(self):
        cases = {**TEMPLATES, "torus": (*torus(), ["not a sphere"])}
        files = {f"{name.replace(' ', '_')}.mol": molecule(corners, triangles)
                 for name, (corners, triangles, _) in cases.items()}
        table = {}
        for name, (_, _, words) in cases.items():
            file = name.replace(" ", "_") + ".mol"
            words = words if "Angles" in words[0] else ["not a closed oriented surface", *words]
            table[name + ": fix rbc/membrane"] = (
                dict(membrane=f"molecule bad {file}\nfix mem all rbc/membrane bad neo-hookean 1"),
                ["Molecule template bad", "fix rbc/membrane", *words])
            table[name + ": rbc/create"] = (
                dict(cells=f"molecule bad {file}\nrbc/create bad single 6 6 6"),
                ["Molecule template bad", "rbc/create", *words])
        self.check(table, files=files)

    def test_template_of_a_good_octahedron_is_accepted(self):
        script = scene(molecule="molecule rbc good.mol", run="run 0")
        result = attempt(script, files={"good.mol": molecule(CORNERS, OCTAHEDRON)})
        self.assertEqual(result.code, 0, result.printed)

    def test_other_template_files(self):
        good = molecule(CORNERS, OCTAHEDRON)
        table = {
            "two molecules in one template": (dict(molecule="molecule rbc good.mol good.mol"),
                                              ["Molecule template rbc", "one molecule, not 2"]),
            "no coordinates": (dict(molecule="molecule rbc bare.mol"),
                               ["Molecule template rbc", "no Coords"]),
        }
        bare = good[:good.index("Coords")] + good[good.index("Types"):]
        self.check(table, files={"good.mol": good, "bare.mol": bare})


if __name__ == "__main__":
    unittest.main()
