"""Running students' code: a Python file, any program, or a file of rays; each is a Student."""
