"""Lecture files that travel with the program: data only. docs/lectures.md describes the format."""
