"""The probe: everything that happens along the viewing ray of one pixel."""
