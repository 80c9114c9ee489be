"""The instruments: each shows one view of the camera, and has a folder of its own."""
