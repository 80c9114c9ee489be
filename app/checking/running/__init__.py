"""Runs what a student wrote: a Python file, any program, a file of rays; each is a Student."""
