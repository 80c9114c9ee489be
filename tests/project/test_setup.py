"""scripts/setup.sh with stand-ins for Python and apt."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FILES = ("requirements.txt", "requirements-dev.txt")


# A stand-in for Python: it records its arguments, and fails where a test says so.
PYTHON = """#!/bin/sh
echo "python $*" >>"$LOG"
case "$*" in
    *" pip "*) exit "${PIP_STATUS:-0}" ;;
    *"python%d"*) echo python3.11-venv ;;
    *"import ensurepip"*) exit "${ENSUREPIP_STATUS:-0}" ;;
    *"-m venv"*) mkdir -p .venv/bin && cp "$0" .venv/bin/python ;;
esac
"""
APT_GET = """#!/bin/sh
echo "apt-get $*" >>"$LOG"
case "$*" in *osmesa*) exit 100 ;; esac
"""
DPKG_QUERY = "#!/bin/sh\nexit 1\n"


@pytest.mark.skipif(sys.platform == "win32", reason="a POSIX shell script")
class TestScript:
    @pytest.fixture
    def checkout(self, tmp_path):
        """A checkout with nothing but the set-up, and a PATH of stand-ins; a function runs it."""
        (tmp_path / "scripts").mkdir()
        shutil.copy(ROOT / "scripts" / "setup.sh", tmp_path / "scripts")
        for name in (*FILES, "pyproject.toml"):
            (tmp_path / name).write_text(f"content of {name}\n")
        (tmp_path / "bin").mkdir()
        for tool in ("cat", "dirname", "env", "grep", "mkdir", "rm", "cp"):
            (tmp_path / "bin" / tool).symlink_to(shutil.which(tool))
        self.tools = tmp_path / "bin"
        self.stand_in(
            "uname", "#!/bin/sh\n[ $# = 0 ] || [ $1 != -m ] && echo Linux || echo x86_64\n"
        )
        self.stand_in("id", "#!/bin/sh\necho 1000\n")
        self.stand_in("locale", "#!/bin/sh\necho en_US.utf8\n")
        self.stand_in("python3.11", PYTHON)
        return tmp_path

    def stand_in(self, name, content):
        (self.tools / name).write_text(content)
        (self.tools / name).chmod(0o755)

    def setup(self, checkout, *arguments, **environment):
        """Exit status, standard error, and the calls of Python and apt that changed something."""
        log = checkout / "log"
        log.write_text("")
        end = subprocess.run(
            ["/bin/sh", "scripts/setup.sh", *arguments],
            cwd=checkout,
            env={"PATH": str(self.tools), "LOG": str(log), **environment},
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        calls = [line for line in log.read_text().splitlines() if " -c " not in line]
        assert not end.stdout
        return end.returncode, end.stderr, calls

    def test_a_second_run_does_nothing(self, checkout):
        status, _, calls = self.setup(checkout)
        assert status == 0
        assert [call.split()[:5] for call in calls] == [
            ["python", "-m", "venv", "--clear", ".venv"],
            ["python", "-m", "pip", "--quiet", "install"],
            ["python", "-m", "pip", "--quiet", "install"],
        ]
        assert "--require-hashes" in calls[1]
        assert "--no-index" in calls[2]
        assert self.setup(checkout) == (0, "", [])

    def test_what_failed_is_tried_again(self, checkout):
        assert self.setup(checkout, PIP_STATUS="1")[0] != 0
        status, _, calls = self.setup(checkout)
        assert status == 0
        assert sum("--require-hashes" in call for call in calls) == 1

    def test_without_python(self, checkout):
        (self.tools / "python3.11").unlink()
        status, told, _ = self.setup(checkout)
        assert status != 0
        assert "found no Python 3.11 or newer" in told

    def test_without_the_right_to_install_the_command_is_told_and_it_goes_on(self, checkout):
        self.with_apt()
        self.stand_in("sudo", "#!/bin/sh\nexit 1\n")
        status, told, calls = self.setup(checkout, ENSUREPIP_STATUS="1")
        assert status == 0
        assert "sudo apt-get install --no-install-recommends libegl1 libgl1" in told
        assert "--no-install-recommends python3.11-venv" in told
        assert not [call for call in calls if call.startswith("apt-get")]
        assert self.setup(checkout) == (0, "", [])

    def test_more_is_installed_only_for_development_and_tests(self, checkout):
        self.with_apt()
        self.stand_in("id", "#!/bin/sh\necho 0\n")
        status, _, calls = self.setup(checkout)
        assert status == 0
        (installed,) = [call for call in calls if " install --yes " in call]
        assert installed.endswith("libegl1 libgl1 libgl1-mesa-dri locales")
        assert not [call for call in calls if "requirements-dev.txt" in call]
        status, _, calls = self.setup(checkout, "dev")
        assert status == 0 and len(calls) == 1 and "requirements-dev.txt" in calls[0]
        status, told, calls = self.setup(checkout, "tests")
        assert status == 0
        installed = [call.split()[-1] for call in calls if " install --yes " in call]
        assert installed == ["libosmesa6", "xvfb", "openbox", "xdotool", "chromium"]
        assert "sudo apt-get install --no-install-recommends libosmesa6" in told  # has failed
        assert self.setup(checkout, "tests") == (0, "", [])

    def with_apt(self):
        self.stand_in("apt-get", APT_GET)
        self.stand_in("dpkg-query", DPKG_QUERY)
