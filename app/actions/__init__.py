"""Everything that a menu, a key or the command palette does, in one table.

base     what an action is
table    all of them, in the menus' order; camera, image, ... each a part of it
palette  the list of the command palette; commanding: what it offers now
"""
