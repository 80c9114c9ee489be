"""The formats, a module each: what the real program says of our files, and we of its own."""
