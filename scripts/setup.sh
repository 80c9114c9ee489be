#!/bin/sh
# Prepare .venv and, with apt and the rights to use it, the system's packages.
#
# setup.sh: what running needs. setup.sh dev: the linters' and tests' packages, too. setup.sh tests:
# also the display, window manager, keyboard and browser of some tests.
#
# Run it again at any time. Each step leaves a stamp in .venv that holds what it was made from; only
# a stamp that differs is redone, so that a second run does not touch the network.
#
# PYTHON=/path/to/python chooses the interpreter. pip's own configuration (mirrors) is respected.

# shellcheck disable=SC2086 # a list of packages is meant to be split
set -eu
cd "$(dirname "$0")/.."

VENV=.venv
GL_PACKAGES="libegl1 libgl1 libgl1-mesa-dri locales"
DESK_PACKAGES="libosmesa6 xvfb openbox xdotool chromium"

main() {
    usable_venv || make_venv
    distribution=$(cat /etc/os-release 2>/dev/null || uname -s)
    step system "$GL_PACKAGES $distribution"
    step packages "$(cat requirements.txt)"
    step project "$(pwd && cat pyproject.toml)"
    [ -z "${1:-}" ] || step dev "$(cat requirements-dev.txt)"
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

usable_venv() { is_recent "$VENV/bin/python" && "$VENV/bin/python" -c 'import pip' 2>/dev/null; }

is_recent() { "$1" -c 'import sys; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1; }

make_venv() {
    for python in ${PYTHON:-python3.11 python3.12 python3.13 python3.14 python3}; do
        ! is_recent "$python" || break
    done
    is_recent "$python" ||
        fail "found no Python 3.11 or newer; install one, or name it: PYTHON=/path/to/python make run"
    # Debian and Ubuntu keep venv in a package of its own.
    "$python" -c 'import ensurepip' 2>/dev/null ||
        apt_install "$("$python" -c 'import sys; print("python%d.%d-venv" % sys.version_info[:2])')"
    say "making $VENV"
    "$python" -m venv --clear "$VENV"
}

install_packages() {
    say "installing the Python packages that running needs (once)"
    pip install --require-hashes --requirement requirements.txt
}

install_project() {
    pip install --no-deps --no-index --no-build-isolation --editable .
}

install_dev() {
    say "installing the linters' and tests' Python packages (once)"
    pip install --require-hashes --requirement requirements-dev.txt
}

# pip's scratch files lie next to what it installs, so that a small /tmp does not matter.
pip() {
    mkdir -p "$VENV/tmp"
    TMPDIR=$PWD/$VENV/tmp PIP_USER=0 PIP_DISABLE_PIP_VERSION_CHECK=1 \
        "$VENV/bin/python" -m pip --quiet "$@"
    rm -rf "$VENV/tmp"
}

# Nothing here is fatal: the program itself says what is missing, and formulas are plain text
# without the locale.
install_system() {
    if [ "$(uname -m)" = x86_64 ]; then
        apt_install $GL_PACKAGES
    else # moderngl has no wheels here: pip compiles it
        apt_install $GL_PACKAGES g++ libx11-dev python3-dev
    fi
    if command -v locale-gen >/dev/null && ! locale -a | grep -qi '^en_US\.utf-*8$'; then
        as_root sh -c 'echo en_US.UTF-8 UTF-8 >>/etc/locale.gen; locale-gen >/dev/null' || true
    fi
}

# Neither is this: tests that need one of them say so, and are skipped.
install_desk() {
    for package in $DESK_PACKAGES; do # newer distributions have no libosmesa6
        apt_install "$package"
    done
}

# Install those of the packages that are missing, or say how.
apt_install() {
    command -v dpkg-query >/dev/null || return 0
    missing=
    for package; do
        # shellcheck disable=SC2016 # dpkg's format
        status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) || true
        [ "$status" = installed ] || missing="$missing $package"
    done
    [ -n "$missing" ] || return 0
    say "installing with apt-get:$missing"
    { as_root apt-get -qq update && as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq \
        -o DPkg::Lock::Timeout=300 install --yes --no-install-recommends $missing; } >/dev/null ||
        say "that failed; run: sudo apt-get install --no-install-recommends$missing"
}

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi
}

main "$@"
