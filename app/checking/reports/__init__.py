"""Reports of a check: on the terminal, for an autograder, and as a page."""
