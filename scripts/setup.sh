#!/bin/sh
# Prepare everything that Lucida needs: .venv with the pinned packages and the project itself, and
# where they are missing, the system's GL libraries and the locale that typesets formulas.
#
# Run it again at any time: what is up to date is left alone, without touching the network. Each
# step leaves a stamp in .venv that holds what it was made from; a stamp that differs is redone.
#
# setup.sh tests: also the display, window manager, keyboard, sandbox and browser of some tests.
#
# PYTHON=/path/to/python chooses the interpreter. pip's own configuration (mirrors) is respected.

# shellcheck disable=SC2086 # a list of packages is meant to be split
set -eu
cd "$(dirname "$0")/.."

VENV=.venv
GL_PACKAGES="libegl1 libgl1 libgl1-mesa-dri libosmesa6"
DESK_PACKAGES="xvfb openbox xdotool chromium"
LOCALE=en_US.UTF-8

main() {
    usable_venv || make_venv
    step packages "$(cat requirements.txt requirements-dev.txt)"
    step project "$(pwd && cat pyproject.toml)"
    distribution=$(cat /etc/os-release 2>/dev/null || uname -s)
    step system "$GL_PACKAGES $LOCALE $distribution"
    [ "${1:-}" != tests ] || step desk "$DESK_PACKAGES $distribution"
}

# step NAME INPUT: run install_NAME unless it was last done from the same INPUT.
step() {
    stamp=$VENV/setup-$1
    if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$2" ]; then
        return
    fi
    "install_$1"
    printf '%s\n' "$2" >"$VENV/setup-$1"
}

say() { printf 'setup: %s\n' "$*" >&2; }

fail() {
    say "$*"
    exit 1
}

# The virtual environment

usable_venv() {
    [ -x "$VENV/bin/python" ] && is_recent "$VENV/bin/python" &&
        "$VENV/bin/python" -c 'import pip' 2>/dev/null
}

is_recent() { "$1" -c 'import sys; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1; }

make_venv() {
    python=$(find_python)
    version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
    if ! "$python" -c 'import ensurepip, venv' 2>/dev/null; then
        # Debian and Ubuntu keep it in a package of its own.
        if has_apt && has_rights; then
            apt_install "python$version-venv" || true # what follows tells
        fi
        "$python" -c 'import ensurepip, venv' 2>/dev/null ||
            fail "$python makes no virtual environments; run: $(apt_command "python$version-venv")"
    fi
    say "making $VENV with Python $version"
    "$python" -m venv --clear "$VENV"
}

find_python() {
    if [ -n "${PYTHON:-}" ]; then
        is_recent "$PYTHON" || fail "PYTHON=$PYTHON is not Python 3.11 or newer"
        echo "$PYTHON"
        return
    fi
    for candidate in python3.11 python3.12 python3.13 python3.14 python3; do
        if is_recent "$candidate"; then
            echo "$candidate"
            return
        fi
    done
    fail "no Python 3.11 or newer was found; install one, or name it: PYTHON=/path/to/python make"
}

# Python packages

install_packages() {
    if [ "$(uname -s)" = Linux ] && [ "$(uname -m)" != x86_64 ] && has_apt && has_rights; then
        # moderngl and glcontext have no wheels here: pip compiles them.
        version=$("$VENV/bin/python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
        missing=$(missing_packages g++ libx11-dev "python$version-dev")
        [ -z "$missing" ] || apt_install $missing || true
    fi
    say "installing the Python packages (about 200 MB, once)"
    pip install --require-hashes --requirement requirements.txt --requirement requirements-dev.txt
}

install_project() {
    pip install --no-deps --no-index --no-build-isolation --editable .
}

pip() {
    # Its scratch files lie beside what it installs, so that a small /tmp does not matter.
    mkdir -p "$VENV/tmp"
    TMPDIR=$PWD/$VENV/tmp PIP_USER=0 PIP_DISABLE_PIP_VERSION_CHECK=1 \
        "$VENV/bin/python" -m pip --quiet "$@"
    rm -rf "$VENV/tmp"
}

# System libraries

install_system() {
    if has_apt; then
        install_gl
        install_locale
    elif [ "$(uname -s)" != Darwin ]; then # macOS brings its own OpenGL
        has_gl || fail "OpenGL is missing; install Mesa's EGL (Fedora: mesa-libEGL mesa-libGL" \
            "mesa-dri-drivers, Arch: mesa), then run this again"
    fi
}

install_gl() {
    missing=$(missing_packages $GL_PACKAGES)
    [ -n "$missing" ] || return 0
    if has_rights && apt_install $missing; then
        return
    fi
    has_gl || fail "OpenGL is missing; run: $(apt_command $missing)"
    offered=$(offered_packages $missing)
    [ -z "$offered" ] || say "for all of OpenGL's platforms run: $(apt_command $offered)"
}

# Whether a context can be had on EGL, or OSMesa is there.
has_gl() {
    "$VENV/bin/python" - >/dev/null 2>&1 <<'END'
import ctypes, ctypes.util, moderngl

try:
    moderngl.create_context(standalone=True, backend="egl", require=330)
except Exception:
    ctypes.CDLL(ctypes.util.find_library("OSMesa") or "libOSMesa.so.8")
END
}

# Nothing here is fatal: tests that need a display or a browser say so, and are skipped.
install_desk() {
    has_apt || return 0
    missing=$(missing_packages $DESK_PACKAGES)
    [ -n "$missing" ] || return 0
    if has_rights && apt_install $missing; then
        return
    fi
    say "tests on a display, of walls, or of a browser are skipped; for them run: $(apt_command $missing)"
}

# Nothing here is fatal: without the locale, formulas are plain text.
install_locale() {
    ! locale -a 2>/dev/null | grep -qi '^en_US\.utf-*8$' || return 0
    if ! has_rights; then
        say "formulas stay plain text without the locale $LOCALE; run: $(apt_command locales)" \
            "&& sudo sed -i 's/^# *$LOCALE/$LOCALE/' /etc/locale.gen && sudo locale-gen"
        return
    fi
    missing=$(missing_packages locales)
    [ -z "$missing" ] || apt_install $missing || return 0
    say "generating the locale $LOCALE"
    as_root sed -i "s/^# *$LOCALE/$LOCALE/" /etc/locale.gen 2>/dev/null || true
    grep -qs "^$LOCALE" /etc/locale.gen ||
        echo "$LOCALE UTF-8" | as_root tee -a /etc/locale.gen >/dev/null
    output=$(as_root locale-gen 2>&1) || say "$output"
}

# apt

has_apt() { command -v apt-get >/dev/null && command -v dpkg-query >/dev/null; }

has_rights() {
    [ "$(id -u)" = 0 ] || { command -v sudo >/dev/null && sudo -n true 2>/dev/null; }
}

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi
}

# Those of the packages that are not installed.
missing_packages() {
    for package; do
        # shellcheck disable=SC2016 # dpkg's format
        status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) || true
        [ "$status" = installed ] || printf '%s ' "$package"
    done
}

# Those of the packages that the distribution has. (Mesa 25 dropped OSMesa.)
offered_packages() {
    for package; do
        ! LC_ALL=C apt-cache policy "$package" 2>/dev/null | grep -q 'Candidate: [^(]' ||
            printf '%s ' "$package"
    done
}

apt_install() {
    apt_get update || say "apt-get update failed; going on with the lists that are here"
    offered=$(offered_packages "$@")
    [ -n "$offered" ] || return 0
    say "installing with apt-get: $offered"
    apt_get install --yes --no-install-recommends $offered
}

# Silent, unless it fails.
apt_get() {
    output=$(as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get -q -o DPkg::Lock::Timeout=300 "$@" 2>&1) || {
        printf '%s\n' "$output" >&2
        return 1
    }
}

apt_command() { echo "sudo apt-get update && sudo apt-get install --no-install-recommends $*"; }

main "$@"
