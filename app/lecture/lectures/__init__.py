"""The built-in lectures: data only. docs/lectures.md describes the format."""
