"""The system packages to install, on each operating system, for a missing part."""

from __future__ import annotations

import sys
from importlib.util import find_spec


def installing(packages: str) -> str:
    """Return the command that installs packages for this interpreter, from pip, uv or pipx."""
    if find_spec("pip") is None:  # as in uv's environments
        return f"uv pip install --python {sys.executable} {packages}"
    return f"{sys.executable} -m pip install {packages}"


SYSTEMS = ("debian", "fedora", "arch", "macos", "windows", "other")

_GONE = "Mesa 25.1 and later have no OSMesa: EGL takes its place"
_DRIVER = "update the graphics driver (OpenGL 3.3)"

_REMEDIES = {
    "egl": {
        "debian": "apt-get install libegl1 libgl1 libgl1-mesa-dri",
        "fedora": "dnf install mesa-libEGL mesa-libGL mesa-dri-drivers",
        "arch": "pacman -S libglvnd mesa",
        "other": "install libEGL, libGL and Mesa's drivers",
    },
    "default": {"other": _DRIVER},
    "osmesa": {
        "debian": "apt-get install libosmesa6, if the release has it; or else use EGL",
        "fedora": "dnf install mesa-libOSMesa (in newer releases: mesa-compat-libOSMesa)",
        "other": _GONE,
    },
    "display": {
        "debian": "log in to a desktop, or apt-get install xvfb and start with xvfb-run",
        "fedora": "log in to a desktop, or dnf install xorg-x11-server-Xvfb, start with xvfb-run",
        "arch": "log in to a desktop, or pacman -S xorg-server-xvfb and start with xvfb-run",
        "other": "log in to a desktop",
    },
    "tracer": {"other": "pip install --upgrade numba"},
    "formulas": {
        "debian": "apt-get install locales; localedef -i en_US -f UTF-8 en_US.UTF-8",
        "fedora": "dnf install glibc-langpack-en",
        "arch": "uncomment en_US.UTF-8 in /etc/locale.gen and run locale-gen",
        "other": "add the locale en_US.UTF-8",
    },
    "films": {"other": installing("av distributed")},
    "cluster": {"other": installing("av distributed")},
    "widget": {"other": installing("anywidget")},
    "command": {"other": "add it to the PATH (pipx ensurepath, uv tool update-shell)"},
    "imports": {"other": "rename these files, or start Python and notebooks in another folder"},
}


def remedy(part: str, system: str = "") -> str:
    """Return one line of instructions for a part of renderer/system/doctor.py.

    system: one of SYSTEMS; "" for the current one.
    """
    remedies = _REMEDIES[part]
    return remedies.get(system or this_system(), remedies["other"])


def this_system() -> str:
    """Return one of SYSTEMS; Ubuntu, Mint and others count as the system they derive from."""
    if sys.platform in ("darwin", "win32"):
        return {"darwin": "macos", "win32": "windows"}[sys.platform]
    import platform

    try:
        release = platform.freedesktop_os_release()
    except OSError:
        return "other"
    names = f"{release.get('ID', '')} {release.get('ID_LIKE', '')}".split()
    if "rhel" in names:
        names.append("fedora")
    return next((name for name in names if name in SYSTEMS), "other")
