"""The camera: its checks, its intrinsics and lenses, and how it is navigated."""
