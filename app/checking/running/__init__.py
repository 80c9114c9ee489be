"""Running students' code: a Python file or any program; each is a Student."""
