"""Images on their way: the tracer, its thread, what it prepares and compiles."""
