"""`lucida install-desktop`: Lucida in the menu of a Linux desktop, a man page, and completion.

Writes into the user's own folder of data, as the XDG Base Directory specification names it.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from app.commands.completion import Parsers, completion
from app.commands.manual import PURPOSE, man_page
from renderer.errors import LucidaError

NAME = "install-desktop"

DESCRIPTION = """\
Put Lucida into the menu of a Linux desktop, and into "Open with" of .obj, .gltf, .glb and .stl;
install a man page, and the completion of bash and fish. All for this user only."""

EPILOG = """\
The files are written to $XDG_DATA_HOME, or else ~/.local/share, and named.
exit status: 0 done, 2 a failure

examples:
  lucida install-desktop
  lucida install-desktop --remove"""

TYPES = ("model/obj", "model/gltf+json", "model/gltf-binary", "model/stl")

_ENTRY = """\
[Desktop Entry]
Type=Application
Name=Lucida
GenericName=Camera and Rendering Viewer
Comment={comment}
Exec={command} %f
Icon=lucida
Terminal=false
Categories=Education;ComputerScience;
MimeType={types}
StartupWMClass=Lucida
"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("--remove", action="store_true", help="remove these files")


def run(arguments: argparse.Namespace) -> int:
    import platformdirs

    if sys.platform in ("darwin", "win32"):
        remedy = "start `lucida` in a terminal, or make a shortcut to it"
        raise LucidaError("", "this command is for desktops of Linux and BSD", remedy)
    data = platformdirs.user_data_path()
    files = desktop_files(_own_command(), arguments.parsers())
    if arguments.remove and not any((data / name).exists() for name in files):
        print(f"nothing of Lucida is in {data}")
    for name, text in files.items():
        path = data / name
        if not arguments.remove:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, "utf-8")
            print(f"wrote {path}")
        elif path.exists():
            path.unlink()
            print(f"removed {path}")
    refresh = shutil.which("update-desktop-database")  # builds the index for "Open with"
    if refresh and (data / "applications").is_dir():
        subprocess.run([refresh, data / "applications"], capture_output=True, check=False)
    return 0


def desktop_files(command: Path, parsers: Parsers) -> dict[str, str]:
    """Return the text of each file by its path below the user's folder of data.

    command: the program that the menu starts. parsers: of the commands, as for completion().
    """
    icon = Path(__file__).with_name("lucida.svg")
    return {
        "applications/lucida.desktop": _ENTRY.format(
            comment=f"{PURPOSE[0].upper()}{PURPOSE[1:]}",
            command=quoted(str(command)),
            types="".join(f"{type};" for type in TYPES),
        ),
        "icons/hicolor/scalable/apps/lucida.svg": icon.read_text("utf-8"),
        "man/man1/lucida.1": man_page(parsers),
        "bash-completion/completions/lucida": completion("bash", parsers),
        "fish/vendor_completions.d/lucida.fish": completion("fish", parsers),
    }


def quoted(path: str) -> str:
    """Return a path as the key Exec of the Desktop Entry specification has it.

    It is quoted as an argument, then its backslashes as in any string; % begins a field code.
    """
    argument = re.sub(r'(["`$\\])', r"\\\1", path)
    return '"' + argument.replace("\\", "\\\\").replace("%", "%%") + '"'


def _own_command() -> Path:
    """Return the command of this Python. Raises LucidaError."""
    path = Path(sysconfig.get_path("scripts"), "lucida")
    if not path.exists():
        raise LucidaError("", f"{path} does not exist", "install Lucida with pip, pipx or uv")
    return path
