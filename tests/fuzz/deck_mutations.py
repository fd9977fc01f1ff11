"""Changes to decks: to words and lines of scripts, templates and materials, and to bytes of STL
files."""

import re

from deck_bases import SCRIPT, stl_binary, stl_text

NUMBERS = ["0", "-1", "1", "2", "3", "1e-300", "1e300", "-1e300", "1e-9", "1e9", "nan", "inf",
           "-inf", "0.5", "1e", "2147483647", "2147483648", "-2147483648", "9223372036854775807",
           "18446744073709551616", "1.5", "0x10", "1e308", "5e-324", "٣", "", "INF", "EDGE", "NULL"]
WORDS = """
    adapt adhesive aggregate all area attempts auto ab2 bending body c_cell c_none c_cell[1] courant
    coupled crease density dihedral direct dx elastic euler f_flow f_flow[1] f_flow[99] flow grid
    helfrich hematocrit inertia inside integrator interior kernel maxiter mean membrane midpoint mix
    molecule mooney-rivlin neo-hookean no none number offset order overlap peskin4 projection rbc
    random reference region repulsive rkc roma3 rotate scale scheme seed self sheets shift single
    skalak slip spacing stretch stress-free swell tension thinning tol type unsteady unwrap v_none
    v_speed vessel velocity virial viscosity volume wall yes zhi zlo convective * ** 1*2 2* ''
    """.split()
LINES = """
    boundary p p f|boundary f f f|boundary s p p|boundary p p p|newton off|newton on off
    processors 1 1 *|processors * 1 1|atom_style full|atom_style atomic|atom_style bond|units lj
    units si|dimension 2|special_bonds lj 1 1 1|atom_modify map hash|atom_modify sort 0 0
    neighbor 0 bin|neighbor 5 nsq|comm_style tiled|comm_modify mode multi|comm_modify cutoff 0.1
    balance 1.0 shift xyz 5 1.0|balance 1.0 rcb|run 0|run 2|run 2 pre no|run 2 every 1 "print 1"
    run 2 post no|reset_timestep 0|reset_timestep 100000|delete_atoms group all
    delete_atoms random count 5 yes all NULL 7|delete_atoms group all mol yes
    displace_atoms all move 100 0 0|displace_atoms all random 1 1 1 5|velocity all create 300 5
    velocity all set NULL 1 0|change_box all x scale 0.5|change_box all x scale 1.5 remap
    change_box all z delta 0 1|change_box all triclinic|change_box all boundary p p f
    set group all mol 1|set group all type 1|set group all image 1 0 0|set atom 1 mol 5
    group cells clear|group all2 type 1|group dyn dynamic all every 1|mass * 1|mass 1 0.5|timestep 0
    timestep 1e-9|timestep 1e6|timestep -1|fix nve all nve|fix f all setforce 0 0 0
    fix add all addforce 1 0 0|fix bal all balance 1 1.0 shift xyz 5 1.0
    fix d all deform 1 x erate 0.01|fix npt all press/berendsen iso 1 1 1
    fix freeze all move linear 0 0 0|fix halt all halt 1 v_none > 0|fix rig all rigid molecule
    fix e all evaporate 1 1 box 5|unfix flow|unfix ib|unfix membrane|unfix wall|uncompute cell
    write_restart w.restart|write_data w.data|read_restart w.restart|read_data w.data add append
    write_dump all atom w.dump|read_dump w.dump 0 x y z|rerun w.dump dump x y z|clear|restart 1 r.*
    thermo_modify lost ignore|thermo_modify lost warn|thermo_modify norm yes|thermo 1
    thermo_style multi|minimize 0 0 2 2|fix_modify membrane energy yes virial yes
    fix_modify flow energy yes|fix_modify ib respa 1|run_style respa 2 2|run_style verlet
    neigh_modify every 1 delay 0 check no|neigh_modify exclude group all all|neigh_modify once yes
    compute c2 all rbc/cell|compute a2 all rbc/aggregate 1.0 area 0.5|fix s2 all rbc/vtk 1 s.*.vtp
    fix s3 all rbc/vtk 1 s.*.pvtp|fix ib2 all rbc/ib flow|fix m2 all rbc/membrane rbc skalak 1 1
    fix flow2 all rbc/fluid grid 8 8 8 viscosity 1 density 1|fix w2 all rbc/wall flow
    rbc/surface vessel type 1 spacing 1|rbc/surface box type 1 spacing 2|rbc/create rbc single 0 0 0
    rbc/create rbc number 1 seed 3 attempts 50|region r2 rbc/mesh vessel.stl
    region r3 rbc/mesh cell.mol|region vessel delete|pair_style rbc/jkr 0.6 self yes
    pair_style zero 1.0|pair_style none|pair_coeff * * repulsive 1 0.3
    pair_coeff * * adhesive 1 1e-3 0.3|reset_atoms id|reset_atoms mol all|reset_atoms image all
    replicate 2 1 1|dump g all grid 1 g.* f_flow:grid:velocity[9]
    dump a all custom 1 a.* id f_membrane f_ib c_cell|fix g all ave/grid 1 1 1 4 4 4 vx
    molecule rbc cell.mol scale 0.001|molecule rbc cell.mol scale 100|molecule rbc2 cell.mol
    fix ag all ave/time 1 2 2 c_agg[*] mode vector ave running
    """


def lines_to_insert():
    return [line.strip() for row in LINES.strip().splitlines() for line in row.split("|")]


def _number(random, word):
    """Another number in place of a word, near it or not."""
    if random.random() < 0.5:
        return random.choice(NUMBERS)
    try:
        value = float(word)
    except ValueError:
        return random.choice(NUMBERS)
    return repr(random.choice([-value, 10 * value, value / 10, 1000 * value, value + 1,
                               value * (1 + 1e-9), value / 1e6]))


def _change_word(random, line):
    words = line.split()
    if not words:
        return line
    place = random.randrange(len(words))
    action = random.choice(["number", "number", "number", "word", "word", "drop", "twice", "swap",
                            "cut", "letter"])
    if action == "number":
        numeric = [n for n, word in enumerate(words) if re.search(r"\d", word)] or [place]
        place = random.choice(numeric)
        words[place] = _number(random, words[place])
    elif action == "word":
        words[place] = random.choice(WORDS)
    elif action == "drop":
        del words[place]
    elif action == "twice":
        words.insert(place, words[place])
    elif action == "swap":
        other = random.randrange(len(words))
        words[place], words[other] = words[other], words[place]
    elif action == "cut":
        del words[place:]
    else:
        letter = random.randrange(len(words[place]) or 1)
        words[place] = (words[place][:letter] + chr(random.randrange(33, 256)) +
                        words[place][letter + 1:])
    return " ".join(words)


def _change_lines(random, lines, others):
    """Changes one of the lines, or their order; returns what was done."""
    place = random.randrange(len(lines))
    before = lines[place]
    action = random.choices(["word", "insert", "other", "drop", "twice", "swap", "move"],
                            [12, 4, 2, 2, 1, 1, 1])[0]
    if action == "word":
        lines[place] = _change_word(random, before)
        return f"line {place + 1}: {before!r} -> {lines[place]!r}"
    if action in ("insert", "other"):
        lines.insert(place, random.choice(others))
        return f"line {place + 1}: new {lines[place]!r}"
    if action == "drop":
        del lines[place]
    elif action == "twice":
        lines.insert(random.randrange(len(lines)), before)
    elif action == "swap":
        other = random.randrange(len(lines))
        lines[place], lines[other] = lines[other], lines[place]
    else:
        lines.insert(random.randrange(len(lines)), lines.pop(place))
    return f"line {place + 1}: {action} {before!r}"


def _change_text(random, text, others):
    lines = text.split("\n")[:-1] or [""]
    done = _change_lines(random, lines, others or lines)
    return "\n".join(lines) + "\n", done


def _change_bytes(random, content):
    """Of a file that a style of ours reads by itself."""
    place = random.randrange(len(content) or 1)
    action = random.choice(["flip", "cut", "insert", "repeat", "zero", "append", "drop"])
    length = random.choice([1, 4, 12, 50])
    if action == "flip":
        content = (content[:place] + bytes([content[place] ^ 1 << random.randrange(8)]) +
                   content[place + 1:])
    elif action == "cut":
        content = content[:place]
    elif action == "insert":
        content = content[:place] + random.randbytes(length) + content[place:]
    elif action == "repeat":
        content = content[:place] + content[place:place + length] * 2 + content[place + length:]
    elif action == "zero":
        content = content[:place] + bytes(length) + content[place + length:]
    elif action == "append":
        content += random.randbytes(length)
    else:
        content = content[:place] + content[place + length:]
    return content, f"{action} {length} at byte {place}"


def _triangles_of(text):
    found = re.findall(r"^vertex (\S+) (\S+) (\S+)$", text, re.MULTILINE)
    corners = [tuple(float(x) for x in corner) for corner in found]
    # without what is left of a damaged one
    return list(zip(corners[::3], corners[1::3], corners[2::3]))


def _change_mesh(random, content):
    """The surface itself, in a file without fault."""
    try:
        triangles = _triangles_of(content.decode("ascii"))
    except ValueError:
        return _change_bytes(random, content)
    if not triangles:
        return _change_bytes(random, content)
    place = random.randrange(len(triangles))
    action = random.choice(["drop", "turn", "twice", "scale", "shift", "flat", "far", "lid",
                            "inside out", "one"])
    a, b, c = triangles[place]
    if action == "drop":
        del triangles[place]
    elif action == "turn":
        triangles[place] = (b, a, c)
    elif action in ("twice", "lid"):
        triangles.append((a, b, (c[0], 6.0, 6.0)) if action == "lid" else (a, b, c))
    elif action in ("scale", "shift", "one"):
        factor = random.choice([1e-6, 0.1, 0.9, 1.1, 3, 1e6, 1e30])
        axis = random.randrange(3)

        def moved(x):
            changed = list(x)
            changed[axis] = x[axis] * factor if action == "scale" else x[axis] + factor
            return tuple(changed)
        triangles = [tuple(x if action == "one" and x != a else moved(x) for x in t)
                     for t in triangles]
    elif action == "flat":
        triangles[place] = (a, a, b)
    elif action == "far":
        triangles[place] = (a, b, (1e30, -1e30, 0))
    else:
        triangles = [(b, a, c) for a, b, c in triangles]
    return (random.choice([stl_text, stl_binary])(triangles),
            f"mesh: {action} at triangle {place + 1}")


def mutate(files, originals, random):
    """The files with one to four changes, and what these are, in words."""
    changes = []
    for _ in range(random.choice([1, 1, 2, 3, 4])):
        names = sorted(files)
        weights = [10 if name == SCRIPT else 4 if name.endswith(".stl") else 1 for name in names]
        name = random.choices(names, weights)[0]
        if name.endswith(".stl"):
            change = random.choice([_change_bytes, _change_mesh])
            files[name], done = change(random, files[name])
        else:
            other = originals[
                random.choice(sorted(originals))][SCRIPT].decode("latin-1").split("\n")[:-1]
            others = lines_to_insert() + other if name == SCRIPT else None
            text = files[name].decode("latin-1")
            if name.endswith(".mol") and random.random() < 0.3:
                files[name], done = _change_bytes(random, files[name])
            else:
                text, done = _change_text(random, text, others)
                files[name] = text.encode("utf-8" if not text.isascii() else "latin-1")
        changes.append(f"{name}: {done}")
    return files, changes
