"""Attacks on the whole program: bounded runs by command, not part of the tests."""
