"""The outside view with its actions."""

from __future__ import annotations

from .actions import OUTSIDE
from .view import OutsideView


class Outside(OutsideView):
    actions = OUTSIDE
