"""Pictures of a series of files as a movie: by ffmpeg, or as an animated GIF or PNG by Pillow."""
import bisect
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from rbc.actors import IDENTITIES, largest_speed, limits_of, round_limits
from rbc.display import display
from rbc.errors import InputError
from rbc.rendering import Look, render
from rbc.snapshots import series
from rbc.surfaces import read_surfaces

ANIMATED = ".gif", ".png"              # by Pillow
VIDEO = ".mp4", ".webm", ".mkv"        # by ffmpeg


def check_format(output):
    """Raises where the file's name asks for what there is not, before pictures are drawn."""
    suffix = Path(output).suffix
    if suffix not in ANIMATED + VIDEO:
        raise InputError(f"{output}: a movie ends in {', '.join(ANIMATED + VIDEO)}")
    if suffix in VIDEO and not shutil.which("ffmpeg"):
        raise InputError(f"{output} needs the program ffmpeg, which the Debian package ffmpeg "
                         "holds; .gif and .png do without")
    if suffix in ANIMATED:
        import PIL.Image  # noqa: F401  raises where it is missing


def flow_of(step, flows):
    """The file of the last step up to that of the cells."""
    place = bisect.bisect_right([flow_step for flow_step, _ in flows], step)
    if not place:
        raise InputError(f"no file of the flow at step {step} or before")
    return flows[place - 1][1]


def common_look(files, flows, look):
    """The same box and limits of colors in all pictures."""
    if look.box is None:
        points = [read_surfaces(name).points for name in files]
        low = [min(frame[:, d].min() for frame in points) for d in range(3)]
        high = [max(frame[:, d].max() for frame in points) for d in range(3)]
        look = look._replace(box=tuple(side for sides in zip(low, high) for side in sides))
    if look.color and look.color not in IDENTITIES and look.range is None:
        limits = [limits_of(name, look.color) for name in files]
        lows, highs = zip(*limits)
        look = look._replace(range=round_limits(min(lows), max(highs)))
    if flows and look.flow_range is None:
        fastest = max(largest_speed(name) for name in flows)
        look = look._replace(flow_range=round_limits(0, fastest))
    return look


def draw_frames(files, flows, folder, look):
    """PNG files of all pictures, in order of the steps."""
    frames, flows = series(files), series(flows)
    shown = [flow_of(step, flows) if flows else None for step, _ in frames]
    look = common_look([name for _, name in frames], set(shown) - {None}, look)
    pictures = []
    with display():
        for number, ((_, name), flow) in enumerate(zip(frames, shown)):
            pictures.append(os.path.join(folder, f"{number:06d}.png"))
            render(name, pictures[-1], look._replace(flow=flow))
    return pictures


def animate(pictures, output, rate):
    from PIL import Image

    images = [Image.open(picture).convert("RGB") for picture in pictures]
    if Path(output).suffix == ".gif":
        # one palette, or colors would flicker
        palette = images[len(images) // 2].quantize(256)
        images = [image.quantize(palette=palette) for image in images]
    images[0].save(output, save_all=True, append_images=images[1:], duration=round(1000 / rate),
                   loop=0)


def encode(folder, output, rate):
    subprocess.run(
        ["ffmpeg", "-v", "error", "-y", "-framerate", f"{rate:g}", "-i",
         os.path.join(folder, "%06d.png"), "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2",
         "-pix_fmt", "yuv420p", os.fspath(output)],
        check=True, capture_output=True, text=True)


def write_movie(files, output, look=Look(), flows=(), rate=10):
    """A movie of .vtp or .pvtp files that are named by their steps, `rate` pictures a second.

    `flows`: files with the velocity, named by their steps too.
    """
    check_format(output)
    with tempfile.TemporaryDirectory() as folder:
        pictures = draw_frames(files, flows, folder, look)
        if Path(output).suffix in VIDEO:
            encode(folder, output, rate)
        else:
            animate(pictures, output, rate)
