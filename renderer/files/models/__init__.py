"""Model files of other programs: OBJ, PLY, STL, OFF and glTF."""
