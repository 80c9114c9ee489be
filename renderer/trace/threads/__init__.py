"""The threads that run a kernel together, and how they divide its work."""
