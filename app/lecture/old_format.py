"""Steps in the format before builds, with revealed lists, answers and links.

They are read as builds, so that the window needs only one mechanism.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from .schema import OldStepTable, StepTable
from .text import Block, ItemList, parse

Blocks = tuple[Block, ...]
FIELDS = ("reveal", "answer", "links", "low", "highlight")
REMEDY = (
    "is of an older format: write later content as [[steps.builds]]; "
    "links, low and highlight are ignored"
)


def kind_of(table: Any) -> type[StepTable]:
    """Return the structure of a step's table, which has not been checked yet.

    Only a table with removed fields gets the structure that has them, so that no message suggests
    one to others.
    """
    is_old = isinstance(table, dict) and not table.keys().isdisjoint(FIELDS)
    return OldStepTable if is_old else StepTable


def fields_of(table: OldStepTable) -> list[str]:
    """Return the removed fields in a step."""
    return [name for name in FIELDS if getattr(table, name)]


def old_builds(table: OldStepTable, blocks: Blocks) -> list[tuple[Blocks, Blocks]]:
    """Return (the blocks that stay, the text) of each build of a step: its lists item by item if it
    reveals them, and then the answer.
    """
    lists = [block for block in blocks if isinstance(block, ItemList) and table.reveal]
    texts = [tuple(_shown(blocks, count)) for count in range(sum(len(x.items) for x in lists))]
    texts.append(blocks)
    if table.answer:
        texts.append((*blocks, *parse(table.answer)))
    return [(_shared(*pair), pair[1]) for pair in itertools.pairwise([(), *texts])]


def _shared(one: Blocks, two: Blocks) -> Blocks:
    """Return the blocks with which both texts begin."""
    pairs = itertools.takewhile(lambda pair: pair[0] == pair[1], zip(one, two, strict=False))
    return tuple(block for block, _ in pairs)


def _shown(blocks: Blocks, count: int) -> Iterator[Block]:
    """Yield a text with the first items of its lists only."""
    for block in blocks:
        if not isinstance(block, ItemList):
            yield block
        elif items := block.items[:count]:
            yield replace(block, items=items)
            count -= len(items)
