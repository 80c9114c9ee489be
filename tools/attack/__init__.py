"""Attacks that take minutes: `make attack`. A module with a main() is a command (__main__.py)."""
