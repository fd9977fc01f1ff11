"""A display for VTK, which draws through an X server, on machines without one."""
import contextlib
import os
import select
import shutil
import subprocess

from vtkmodules.vtkRenderingCore import vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  registers the windows

from rbc.errors import InputError

_open = []    # the private server, while there is one


@contextlib.contextmanager
def display():
    """A private X server, if VTK is built for X and Xvfb is there; else what $DISPLAY names. Within
    another one it does nothing."""
    if _open or not vtkRenderWindow().GetClassName().startswith("vtkX"):
        yield
        return
    if not shutil.which("Xvfb"):
        if not os.environ.get("DISPLAY"):
            raise InputError("neither Xvfb nor a display: install the Debian package xvfb")
        yield
        return
    reader, writer = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writer), "-screen", "0", "640x480x24", "-nolisten", "tcp",
         "-noreset"],
        pass_fds=[writer], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writer)
    before = os.environ.get("DISPLAY")
    try:
        number = b""
        while not number.endswith(b"\n"):
            piece = os.read(reader, 16) if select.select([reader], [], [], 30)[0] else b""
            if not piece:
                raise InputError("Xvfb does not start")
            number += piece
        os.environ["DISPLAY"] = f":{number.decode().strip()}"
        os.environ.setdefault("LIBGL_ALWAYS_SOFTWARE", "1")
        _open.append(server)
        yield
    finally:
        _open.clear()
        os.close(reader)
        server.terminate()
        server.wait()
        if before is None:
            os.environ.pop("DISPLAY", None)
        else:
            os.environ["DISPLAY"] = before
