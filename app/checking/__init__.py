"""Checking students' code: tasks, correct answers, a separate process for the code, the
diagnosis.
"""
