"""Running jobs: the tracer, its thread, its preparations and compilations."""
