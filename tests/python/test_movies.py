"""A movie has a picture for each file, in order, in which cells move as they do in the files."""
import shutil
import subprocess
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import numpy as np
from PIL import Image
from rbc import InputError, Look, write_movie
from rbc.commands.render import main
from vtk_files import sphere, write_grid, write_surfaces

STEPS = 0, 5, 20, 100
BOX = (0, 10.0) * 3
SIZE = 200
PIXELS = SIZE / (1.06 * 10)    # per length: a margin of 6 % around the box
LOOK = Look(box=BOX, view=(0, 0), parallel=True, size=(SIZE, SIZE), occlusion=False)


def place(step):
    """x of the cell."""
    return 2 + step / 20


def frames(path):
    """Colors of all pictures of a movie."""
    with Image.open(path) as movie:
        found = []
        for number in range(movie.n_frames):
            movie.seek(number)
            found.append(np.asarray(movie.convert("RGB"), dtype=float))
        return found


def seen_at(frame):
    """x of what is red."""
    red = (frame[..., 0] > 80) & (frame[..., 1] < 0.6 * frame[..., 0])
    return (np.nonzero(red)[1].mean() - (SIZE - 1) / 2) / PIXELS + 5


class Movies(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        for step in STEPS:
            write_surfaces(self.folder / f"cells.{step}.vtp",
                           {1: sphere(1.5, (place(step), 5, 5), 20)},
                           tension=np.linspace(0, step, 762))
        self.files = list(self.folder.glob("cells.*.vtp"))[::-1]

    def test_of_pillow(self):
        for name in ("cells.gif", "cells.png"):
            write_movie(self.files, self.folder / name, LOOK, rate=4)
            found = frames(self.folder / name)
            self.assertEqual(len(found), len(STEPS))
            for step, frame in zip(STEPS, found):
                self.assertAlmostEqual(seen_at(frame), place(step), delta=0.05)
            with Image.open(self.folder / name) as movie:
                movie.seek(1)
                self.assertEqual(movie.info["duration"], 250)

    @unittest.skipUnless(shutil.which("ffmpeg"), "needs ffmpeg")
    def test_of_ffmpeg(self):
        write_movie(self.files, self.folder / "cells.mp4", LOOK, rate=5)
        subprocess.run(["ffmpeg", "-v", "error", "-i", self.folder / "cells.mp4",
                        self.folder / "frame%d.png"], check=True)
        found = [frames(self.folder / f"frame{n}.png")[0] for n in range(1, len(STEPS) + 1)]
        self.assertFalse((self.folder / f"frame{len(STEPS) + 1}.png").exists())
        for step, frame in zip(STEPS, found):
            self.assertAlmostEqual(seen_at(frame), place(step), delta=0.1)

    def test_view_and_colors_are_the_same_in_all(self):
        # without a box it is the one around all places; x of the cell is then from 0.5 to 8.5
        write_movie(self.files, self.folder / "cells.png",
                    LOOK._replace(box=None, color="tension", size=(SIZE + 33, SIZE)))
        first, *_, last = frames(self.folder / "cells.png")
        bar = slice(SIZE, None)
        np.testing.assert_array_equal(first[:, bar], last[:, bar])
        dark = [frame[:, :SIZE].sum(axis=2).min() for frame in (first, last)]
        self.assertLess(dark[1], dark[0] - 20)    # tension 0 everywhere is pale

    def test_the_flow_is_that_of_the_step_or_the_last_before(self):
        edges = (np.linspace(0, 10, 5),) * 3
        for step, speed in ((0, 0.5), (6, 1)):    # colors are over that of all
            write_grid(self.folder / f"u.{step}.vtr", edges, "Vector",
                       speed * np.ones((4, 4, 4, 3)) / np.sqrt(3))
        look = LOOK._replace(size=(SIZE + 33, SIZE))
        flows = sorted(self.folder.glob("u.*.vtr"))
        write_movie(self.files, self.folder / "cells.png", look, flows)
        above = [frame[25, SIZE // 2].sum() for frame in frames(self.folder / "cells.png")]
        self.assertGreater(above[0], above[2] + 150)
        self.assertEqual(above[1], above[0])
        self.assertLess(above[2], 250)
        self.assertEqual(above[3], above[2])
        with self.assertRaisesRegex(InputError, "no file of the flow at step 0 or before"):
            write_movie(self.files, self.folder / "x.gif", look, flows[1:])

    def test_names(self):
        with self.assertRaisesRegex(InputError, "x.avi: a movie ends in .gif, .png, .mp4"):
            write_movie(self.files, "x.avi")
        with unittest.mock.patch("shutil.which", return_value=None), \
                self.assertRaisesRegex(InputError, "x.mp4 needs the program ffmpeg"):
            write_movie(self.files, "x.mp4")

    def test_command(self):
        main(["--movie", *map(str, self.files), "-o", str(self.folder / "cells.gif"), "--size",
              f"{SIZE}x{SIZE}", "--box", *map(str, BOX), "--view", "0", "0", "--parallel",
              "--no-occlusion"])
        self.assertAlmostEqual(seen_at(frames(self.folder / "cells.gif")[-1]), place(100),
                               delta=0.05)


if __name__ == "__main__":
    unittest.main()
