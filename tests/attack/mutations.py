"""Changes single lines of the pure modules and says which changes no test notices.

    python -m tests.attack mutations --module renderer/camera.py --sample 50 --seed 3

Of each module only the tests named in MODULES run, and of these those that reach the changed
function. Changes that are known to alter nothing stand in equivalent_mutants.toml, with reasons.

A process a module collects the tests once and forks for each mutant, which puts the changed code
into the loaded functions. What no test notices there, and what runs at import, is tried again in a
fresh interpreter, so that nothing survives by having been computed before; --once leaves out the
second try, for whoever looks for tests to write. --minutes: modules are taken in a random order as
long as there is time; one that is not done then is left. Needs fork.

MODULES are held to the last mutant: one that survives and has no reason is a finding. Of ROOMS, the
newer ones, a finding is that fewer than NOTICED of their mutants are noticed, once TRIED were.
"""

from __future__ import annotations

import argparse
import math
import os
import random
import sys
import time
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.attack.forks import forked
from tests.attack.mutants import Mutant, mutants
from tests.attack.mutated_run import collected_run, fresh_run

ROOT = Path(__file__).parents[2]
KNOWN = Path(__file__).with_name("equivalent_mutants.toml")
FRESH_S = 20.0  # for the imports, beside four times what the tests take
SAMPLE = 12  # of each module, where nothing else is asked for

# Which tests hold which module. Those that take long hold it too, but in no reasonable time.
MODULES: dict[str, tuple[str, ...]] = {
    "renderer/camera.py": ("camera", "intrinsics", "edges"),
    "renderer/camera_checks.py": ("camera", "edges"),
    "renderer/intrinsics.py": ("intrinsics",),
    "renderer/camera_formats/opengl.py": ("opengl_cameras", "clipboard_matrices"),
    "renderer/compare.py": ("compare", "compare_report", "comparing", "nothing_hit"),
    "renderer/edges.py": ("edges", "edges_rounding", "slivers", "compare", "compare_report"),
    "renderer/difference.py": ("difference", "comparing", "compare", "compare_report", "bounds"),
    "renderer/shaded_rays.py": ("shaded_rays",),
    "renderer/pixels.py": ("pixels", "go_to_pixel"),
    "renderer/slivers.py": ("slivers",),
    "renderer/camera_formats/chosen.py": ("cli_camera",),
    "app/state/bounds.py": ("bounds", "state"),
    "app/state/app_state.py": ("state", "bounds"),
    "app/state/all_options.py": ("state", "bounds"),
    "app/cameras/animation.py": ("animation", "animation_path", "travel"),
    "app/cameras/basis.py": ("basis", "state"),
    "app/cameras/described.py": ("described",),
    "app/cameras/editing.py": (
        "basis",
        "camera_actions",
        "state",
        "fields",
        "clipboard_camera",
        "clipboard_matrices",
    ),
    "app/host/fly.py": ("fly", "navigation"),
    "app/cameras/focus.py": ("focus", "presets"),
    "app/cameras/navigation.py": ("navigation",),
    "app/cameras/presets.py": ("presets",),
    "app/cameras/reader.py": ("clipboard_camera", "clipboard_matrices", "clipboard_command"),
    "app/cameras/text.py": ("clipboard_camera", "clipboard_matrices", "clipboard_command"),
    "app/cameras/travel.py": ("travel", "animation"),
    "app/images/agreement.py": ("comparing", "live", "live_raster", "status"),
    "app/images/coarseness.py": ("coarseness",),
    "app/images/histogram.py": ("histogram",),
    "app/images/ray_pictures.py": ("ray_pictures",),
    "app/mistakes/model.py": ("wrong_lines",),
    "app/mistakes/question.py": ("question",),
    "app/outside/second_camera.py": ("second_camera",),
    "app/images/imaging.py": ("imaging",),
    "app/images/marking.py": ("imaging", "comparing"),
    "app/images/pixelvalues.py": ("imaging",),
    "app/images/placement.py": ("placement",),
    "app/storage/recent.py": ("files",),
    "app/storage/session.py": ("session", "session_files", "bounds"),
    "app/probe/bundles.py": ("bundles",),
    "app/probe/color_formulas.py": ("probe_lines",),
    "app/explaining/columns.py": ("stepper", "recording", "runs"),
    "app/costs/growth.py": ("growth",),
    "app/costs/model.py": ("costs", "meter"),
    "app/costs/work.py": ("work",),
    "app/probe/copying.py": ("probe_copies", "probe", "probe_lines"),
    "app/probe/crossings.py": ("probe_crossings",),
    "app/probe/formulas.py": ("probe_lines",),
    "app/laboratory/array_code.py": ("array_programs",),
    "app/laboratory/bitmaps.py": ("bitmaps",),
    "app/laboratory/disk.py": ("stored", "pages"),
    "app/laboratory/displays.py": ("displays", "pages"),
    "app/laboratory/kinds.py": ("stored", "bitmaps", "pages"),
    "app/laboratory/light.py": ("light",),
    "app/laboratory/memory.py": ("memory", "pages"),
    "app/laboratory/pages.py": ("pages",),
    "app/laboratory/stored.py": ("stored", "bitmaps"),
    "app/explaining/arithmetic.py": ("exercises", "fields"),
    "app/checking/kinds/values.py": ("values",),
    "app/checking/ray_words.py": ("course_words", "diagnosed"),
    "app/checking/reports/page.py": ("page",),
    "app/checking/reports/picture.py": ("page",),
    "app/checking/reports/pictured.py": ("page",),
    "app/checking/reports/sketch.py": ("page",),
    "app/checking/task_file.py": ("task_file",),
    "app/checking/mistakes/candidates.py": ("diagnosis",),
    "app/checking/mistakes/catalogue.py": ("mistakes", "course_words"),
    "app/checking/mistakes/diagnosis.py": ("diagnosis", "value_mistakes"),
    "app/checking/mistakes/as_basis.py": ("fitted", "diagnosis", "causes"),
    "app/checking/mistakes/as_viewport.py": ("fitted", "diagnosis", "causes"),
    "app/checking/mistakes/difference.py": ("fitted", "diagnosis", "causes"),
    "app/checking/mistakes/differences.py": ("fitted", "diagnosis", "causes"),
    "app/checking/mistakes/fitted.py": ("fitted",),
    "app/checking/mistakes/hits.py": ("value_mistakes",),
    "app/checking/mistakes/program.py": ("mistakes",),
    "app/checking/mistakes/ray_diagnosis.py": ("diagnosis",),
    "app/checking/mistakes/ray_facts.py": ("diagnosis",),
    "app/checking/mistakes/ray_trial.py": ("diagnosis",),
    "app/checking/mistakes/rays.py": ("mistakes", "exercises"),
    "app/checking/mistakes/render.py": ("value_mistakes",),
    "app/checking/mistakes/value_diagnosis.py": ("value_mistakes",),
    "app/checking/mistakes/value_programs.py": ("value_mistakes",),
    "app/checking/mistakes/vectors.py": ("mistakes",),
    "app/lecture/exercises.py": ("exercises",),
    "app/lecture/flow.py": ("flow",),
    "app/lecture/model.py": ("lecture", "lecture_watch", "builtin_lecture"),
    "app/lecture/schema.py": ("lecture_reading", "lecture", "lecture_text"),
    "app/lecture/session.py": ("kept_lecture", "lecture_watch", "lecture"),
    "app/lecture/states.py": ("lecture_ways", "lecture", "lecture_watch", "builtin_lecture"),
    "app/lecture/step_options.py": ("lecture", "builtin_lecture", "bounds"),
    "renderer/scene/places.py": ("places", "lecture"),
    "app/explaining/plain.py": ("plain",),
    "app/lecture/reading.py": (
        "lecture_reading",
        "lecture",
        "lecture_text",
        "lecture_watch",
        "builtin_lecture",
        "outside_files",
    ),
    "app/lecture/text.py": ("lecture_text", "lecture"),
    "app/lecture/under.py": ("lecture_reading", "lecture", "builtin_lecture"),
    "app/lecture/written.py": ("lecture_reading",),
    "app/stepper/loop_parts.py": ("loop_parts", "stepper", "rasterization"),
    "app/stepper/loops.py": ("stepper", "recording", "rasterization"),
    "app/stepper/raster_parts.py": ("rasterization",),
    "app/explaining/notation.py": ("notation",),
    "app/probe/model.py": ("probe_model", "probe_lines"),
    "app/probe/reading.py": ("probe_model", "probe_lines", "probe", "probe_agrees"),
    "app/explaining/projected.py": ("projected",),
    "app/stepper/recording.py": ("recording", "stepper", "rasterization"),
    "app/explaining/shading.py": ("shading",),
    "app/stepper/model.py": ("stepper", "recording", "rasterization"),
}

# Rooms, and their tests: folders, or files. Modules that draw are left out: they need a window.
ROOMS = {
    "app/checking": ("checking/**/test_*",),
    "app/detective": ("detective/test_*",),
    "app/objects": ("objects/test_*",),
    "app/photograph": ("photograph/test_*",),
    "app/poses": ("poses/test_*",),
    "renderer/camera_formats": ("camera_formats/test_*", "commands/test_cli_camera"),
    "renderer/scene_editing": ("scene_editing/test_*",),
    "renderer/scene_export": ("scene_export/test_*", "commands/test_cli_export"),
}
DRAWS = ("imgui_bundle", "moderngl")
SLOW = "checking/running"  # whose tests take minutes
NOTICED, TRIED = 0.8, 20


def room_of(module: str) -> str:
    """Return the room that holds a module; empty if MODULES names it, or none does."""
    return "" if module in MODULES else next((r for r in ROOMS if module.startswith(f"{r}/")), "")


def all_modules() -> list[str]:
    """Return MODULES, and those of ROOMS."""
    found = list(MODULES)
    for room in ROOMS:
        for path in sorted((ROOT / room).rglob("*.py")):
            name, text = path.relative_to(ROOT).as_posix(), path.read_text("utf-8")
            if room_of(name) and SLOW not in name and not any(word in text for word in DRAWS):
                found.append(name)
    return found


def tests_of(module: str) -> list[str]:
    """Return the paths of the test files that hold a module."""
    if room := room_of(module):
        paths = [path for part in ROOMS[room] for path in ROOT.glob(f"tests/{part}.py")]
    else:
        paths = [p for name in MODULES[module] for p in ROOT.glob(f"tests/**/test_{name}.py")]
    return [str(path) for path in paths if SLOW not in path.as_posix()]


@dataclass
class Tally:
    """Of a module. known: to be equivalent, and not tried. survivors: the keys of the others."""

    tried: int = 0
    killed: int = 0
    known: int = 0
    survivors: tuple[str, ...] = ()


def main(argv: Sequence[str]) -> int:
    """1 where a mutant survives that is not known to be equivalent."""
    parser = argparse.ArgumentParser("mutations", description=(__doc__ or "").split("\n")[0])
    modules = all_modules()
    parser.add_argument("--module", action="append", choices=modules, help="may be repeated")
    parser.add_argument("--sample", type=int, default=SAMPLE, help="of each module; 0: all")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--minutes", type=float, help="no further module after that long")
    parser.add_argument("--line", type=int, action="append", help="only its mutants; repeatable")
    parser.add_argument("--once", action="store_true", help="survivors are not tried again afresh")
    arguments = parser.parse_args(argv)
    if not hasattr(os, "fork"):
        print("mutations: this system cannot fork")
        return 0
    known = known_mutants()
    survivors: list[str] = []
    in_rooms, noticed = 0, 0
    modules = list(arguments.module or modules)
    end_s = math.inf
    if arguments.minutes is not None:
        random.shuffle(modules)
        end_s = time.monotonic() + 60 * arguments.minutes
    done = tried = 0
    for module in modules:
        if time.monotonic() >= end_s:
            break
        chosen = mutants(ROOT, module)
        if arguments.line:
            chosen = [mutant for mutant in chosen if mutant.line in arguments.line]
        if 0 < arguments.sample < len(chosen):
            rng = random.Random(f"{arguments.seed} {module}")
            chosen = [chosen[k] for k in sorted(rng.sample(range(len(chosen)), arguments.sample))]
        tally = _try_module(module, chosen, known, arguments.once, end_s)
        if tally is None:
            print(f"{module}: not done in time")
            break
        if room_of(module):
            in_rooms, noticed = (
                in_rooms + tally.killed + len(tally.survivors),
                noticed + tally.killed,
            )
        else:
            survivors += tally.survivors
        done, tried = done + 1, tried + tally.tried
        print(
            f"{module}: {tally.tried} mutants, {tally.killed} noticed, {tally.known} known to be"
            f" equivalent, {len(tally.survivors)} survived",
            flush=True,
        )
    print(
        f"mutations: {done} of {len(modules)} modules, {tried} mutants, {len(survivors)} survived;"
        f" {noticed} of {in_rooms} in the newer rooms noticed",
        flush=True,
    )
    return 1 if survivors or (in_rooms >= TRIED and noticed < NOTICED * in_rooms) else 0


def _afresh(mutant: Mutant, found: dict, tests: list[str]) -> bool:
    """Whether a mutant survives in a fresh interpreter too."""
    reached, lengths = found["reached"], found["lengths"]
    if mutant.function:
        tests = [str(ROOT / test) for test in reached if mutant.function in reached[test]] or tests
        lengths = {name: length for name, length in lengths.items() if str(ROOT / name) in tests}
    limit_s = FRESH_S + 4 * sum(lengths.values())
    return bool(forked(lambda: fresh_run(ROOT, mutant, tests), limit_s) == {"passed": True})


def known_mutants() -> dict[str, str]:
    """Reasons by key."""
    tables = tomllib.loads(KNOWN.read_text()) if KNOWN.exists() else {}
    return {entry["key"]: entry["reason"] for entry in tables.get("mutant", ())}


def _try_module(
    module: str, chosen: list[Mutant], known: dict[str, str], once: bool, end_s: float
) -> Tally | None:
    """Return what came of a module's mutants; None if time was over before."""
    tally = Tally(len(chosen))
    left = [mutant for mutant in chosen if mutant.key not in known]
    tally.known = len(chosen) - len(left)
    tests = tests_of(module)
    # In a process of its own: this one must stay without the module, to fork fresh ones.
    limit_s = min(3600.0 + len(left) * 60.0, end_s - time.monotonic())
    found = forked(lambda: collected_run(ROOT, module, left, tests), limit_s)
    if time.monotonic() >= end_s:
        return None
    if found is None or "error" in found:
        print(f"{module}: the tests do not pass as they are: {found}")
        tally.survivors = (module,)
        return tally
    survivors = []
    for mutant in left:
        outcome = found["outcomes"].get(mutant.key)
        at_import = outcome in (None, "unreached")  # what calls it may run there
        if at_import or (outcome != "killed" and not once):
            if time.monotonic() >= end_s:
                return None
            survived = _afresh(mutant, found, tests)
            outcome = (outcome or "import") if survived else "killed"
        if outcome == "killed":
            tally.killed += 1
        else:
            survivors.append(mutant.key)
            note = " [no test runs it]" if outcome == "unreached" else ""
            print(f"  line {mutant.line}: {mutant.key}{note}", flush=True)
    tally.survivors = tuple(survivors)
    return tally


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
