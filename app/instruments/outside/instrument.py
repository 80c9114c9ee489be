"""The outside view with its actions."""

from __future__ import annotations

from lucida.app.instruments.outside.actions import OUTSIDE
from lucida.app.instruments.outside.view import OutsideView


class Outside(OutsideView):
    actions = OUTSIDE
