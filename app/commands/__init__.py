"""The commands of `lucida`, one per module, which defines NAME, configure(parser) and
run(arguments).

Without a command's name, `lucida` runs app/commands/view.py: the window.
"""

from . import (
    animate,
    camera,
    check,
    compare,
    completion,
    doctor,
    export,
    figure,
    lecture,
    page,
    pick,
    render,
    scene,
    tasks,
)

COMMANDS = (
    render,
    animate,
    compare,
    pick,
    camera,
    export,
    figure,
    page,
    check,
    tasks,
    lecture,
    scene,
    doctor,
    completion,
)
