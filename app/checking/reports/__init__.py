"""What came of a check, told: on the terminal, and as an autograder reads it."""
