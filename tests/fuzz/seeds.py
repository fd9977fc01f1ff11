#!/usr/bin/python3
"""Writes the seeds and the dictionaries of the libFuzzer targets to a folder: seeds.py <folder>."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "helpers"))

from deck_bases import prism, stl_binary, stl_text    # noqa: E402
from deck_mutations import NUMBERS, WORDS             # noqa: E402

# The letter chooses the style: its place in the list of arguments_fuzz.cpp, modulo their number.
STYLES = "fluid ib membrane wall vtk cell aggregate mesh create surface jkr coeff modify".split()
ARGUMENTS = [
    ("fluid", "dx 1.0 viscosity 1.5 density 1.025 inertia none body 0 v_v 0 mean force"),
    ("fluid", "grid 8 9 10 viscosity 1 density 1 inertia convective scheme projection mean 0 0 1"),
    ("fluid", "dx 1 viscosity 1 density 1 inside ball mean x 1e-4"),
    ("fluid", "dx 1 viscosity 1 density 1 wall zlo 0 0 0 wall zhi slip"),
    ("ib", "flow kernel roma3 integrator rkc auto order 3 courant 2 sheets no adapt 0.01 100"),
    ("ib", "flow scheme direct tol 1e-6 maxiter 50 integrator midpoint"),
    ("ib", "flow integrator ab2 kernel peskin4"),
    ("ib", "flow integrator euler"),
    ("membrane", "rbc mooney-rivlin 0.2 0.02 0.01 bending 2e-4 reference dihedral volume yes"),
    ("membrane",
     "rbc skalak 0.005 50 bending 2e-4 0.0 helfrich area 1 0.05 volume 1 crease 0.1 45"),
    ("membrane",
     "rbc neo-hookean 1 stretch 0.1 2 swell v_v viscosity 100 thinning 10 1e-5 stress-free rbc"),
    ("wall", "flow velocity 0 v_v 0 kernel roma3 sheets yes tol 1e-3 maxiter 10"),
    ("vtk", "1 cells.*.vtp unwrap yes aggregate agg"),
    ("vtk", "10 cells.*.pvtp"),
    ("cell", ""),
    ("aggregate", "0.5 area 0.1"),
    ("mesh", "vessel.stl scale 2 shift 1 2 3 side out"),
    ("create", "rbc single 1 2 3 rotate 30 0 1 0 type 1"),
    ("create", "rbc number 1 seed 5 overlap 0.1 mix rbc 0.5 2 region box attempts 2 velocity 0.1"),
    ("create", "rbc hematocrit 0.01 seed 5 attempts 2"),
    ("surface", "ball type 2 spacing 1.5 offset 0.3 mass 1"),
    ("jkr", "0.6 self yes"),
    ("coeff", "1 1 adhesive 0.07 0.001 0.4"),
    ("coeff", "* * repulsive 0.5 0.3"),
    ("coeff", "1 2 none"),
    ("modify", "membrane energy yes virial yes"),
    ("modify", "ib energy yes"),
]
OCTAHEDRON = """\
v 1 0 0
v -1 0 0
v 0 1 0
v 0 -1 0
v 0 0 1
v 0 0 -1
f 1 3 5
f 3 2 5
f 2 4 5
f 4 1 5
f 3 1 6
f 2 3 6
f 4 2 6
f 1 4 6
"""
TETRAHEDRON = "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n"


def letter(style):
    # the first letter of the alphabet's multiples
    first = ord("a") - ord("a") % len(STYLES) + len(STYLES)
    return chr(first + STYLES.index(style))


def quoted(word):
    return '"' + "".join(f"\\x{byte:02x}" for byte in word.encode()) + '"\n'


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    small = prism(sides=4, layers=1)
    seeds = {"stl": {"text": stl_text(small), "binary": stl_binary(small),
                     "prism": stl_text(prism())},
             "template": {"octahedron": OCTAHEDRON.encode(), "tetrahedron": TETRAHEDRON.encode()},
             "arguments": {str(n): (letter(style) + words).encode()
                           for n, (style, words) in enumerate(ARGUMENTS)}}
    words = {"stl": "solid facet normal outer loop vertex endloop endfacet endsolid".split(),
             "template": ["v", "f"], "arguments": WORDS}
    for target, files in seeds.items():
        (folder / target).mkdir(parents=True, exist_ok=True)
        for name, content in files.items():
            (folder / target / name).write_bytes(content)
        entries = [word for word in words[target] + NUMBERS if word]
        (folder / f"{target}.dict").write_text("".join(map(quoted, entries)))


if __name__ == "__main__":
    main()
