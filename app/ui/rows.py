"""The layout of a panel of numbers: labels, columns and lines, in multiples of the type size."""

from __future__ import annotations

from imgui_bundle import ImVec4, imgui

from . import theme

LABEL_EM, WIDE_LABEL_EM = 4.4, 5.6  # next to three fields, next to one
HALF_LABEL_EM = 4.0  # in a line of two fields
TIP_EM = 40.0  # the width of a tooltip: a wider one would not fit next to its item
NARROW_EM, NARROW_LABEL_EM = 16.5, 2.1  # a panel narrower than that has shorter labels


def is_narrow() -> bool:
    """Return True if the line that begins here is too short for full labels in very large type."""
    return imgui.get_content_region_avail().x < NARROW_EM * imgui.get_font_size()


class Thirds:
    """Lines of a label and three fields. Create it at the beginning of the first of them.

    field_px: the width of one field.
    narrow: True if labels must be short.
    """

    def __init__(self) -> None:
        self.narrow = is_narrow()
        label = (NARROW_LABEL_EM if self.narrow else LABEL_EM) * imgui.get_font_size()
        self._spacing = imgui.get_style().item_inner_spacing.x
        self._left = imgui.get_style().window_padding.x + label
        self.field_px = (imgui.get_content_region_avail().x - label - 2 * self._spacing) / 3

    def go(self, column: int) -> None:
        """Move the cursor to one of the fields, 0 to 2, in the label's line."""
        imgui.same_line(self._left + column * (self.field_px + self._spacing))


def label(text: str, role: str, color: ImVec4, fonts: theme.Fonts, tooltip: str) -> None:
    """Draw a name in bold, and its meaning in plain type if there is space."""
    narrow = is_narrow()
    imgui.begin_group()
    imgui.align_text_to_frame_padding()
    imgui.push_font(fonts.bold, 0.0)
    imgui.text_colored(color, text)
    imgui.pop_font()
    if role and not narrow:
        imgui.same_line(0, 0.4 * imgui.get_font_size())
        imgui.align_text_to_frame_padding()
        imgui.text_colored(theme.DIM, role)
    imgui.end_group()
    tip(tooltip)


def row(text: str, role: str, tooltip: str, fonts: theme.Fonts, derived: bool = False) -> float:
    """Draw the label of a line with one field. Return the field's width.

    derived: True if it is not one of the camera's own numbers.
    """
    if derived:
        imgui.align_text_to_frame_padding()
        imgui.text_colored(theme.DIM, text)
        tip(tooltip)
    else:
        label(text, role, theme.TEXT, fonts, tooltip)
    imgui.same_line(imgui.get_style().window_padding.x + WIDE_LABEL_EM * imgui.get_font_size())
    return imgui.get_content_region_avail().x


def instead(text: str) -> None:
    """Draw the reason for a missing field in its place, in several lines if necessary."""
    imgui.align_text_to_frame_padding()
    imgui.push_text_wrap_pos(0.0)
    imgui.text_colored(theme.DIM, text)
    imgui.pop_text_wrap_pos()


class Halves:
    """Lines of two fields, or of one in a narrow panel. Create it at the beginning of the first."""

    def __init__(self) -> None:
        self._one = is_narrow()
        self._left = imgui.get_style().window_padding.x
        self._half = imgui.get_content_region_avail().x / 2

    def begin(self, column: int) -> None:
        """Move the cursor to the label in the first (0) or second (1) half of a line."""
        if column and not self._one:
            imgui.same_line(self._left + self._half)

    def field(self, column: int) -> float:
        """Move the cursor from the label to the field. Return the field's width."""
        if self._one:
            imgui.same_line(self._left + WIDE_LABEL_EM * imgui.get_font_size())
            return imgui.get_content_region_avail().x
        label = HALF_LABEL_EM * imgui.get_font_size()
        imgui.same_line(self._left + column * self._half + label)
        spacing = imgui.get_style().item_inner_spacing.x
        return self._half - label - (0.0 if column else spacing)

    def label(self, column: int, text: str, tooltip: str) -> float:
        """Draw a label in plain type and move to its field. Return the field's width."""
        self.begin(column)
        imgui.align_text_to_frame_padding()
        imgui.text(text)
        tip(tooltip)
        return self.field(column)


def tip(text: str) -> None:
    """Show a tooltip on the last item, in lines that fit the window."""
    if imgui.begin_item_tooltip():
        imgui.push_text_wrap_pos(
            min(TIP_EM * imgui.get_font_size(), 0.9 * imgui.get_main_viewport().work_size.x)
        )
        imgui.text_unformatted(text)
        imgui.pop_text_wrap_pos()
        imgui.end_tooltip()


def line() -> None:
    """Draw a separator."""
    imgui.dummy((0, 0))
    imgui.separator()
    imgui.dummy((0, 0))


def button_width(label: str) -> float:
    """Return the width of a button in pixels. Its text is the part of the label before "##"."""
    return imgui.calc_text_size(label, True).x + 2 * imgui.get_style().frame_padding.x


def follow(width: float) -> None:
    """Put the next item, of this width, in the same row if it fits; otherwise in the next one."""
    spacing = imgui.get_style().item_spacing.x
    end = imgui.get_item_rect_max().x + spacing + width
    edge = imgui.get_cursor_screen_pos().x + imgui.get_content_region_avail().x
    if end <= edge:
        imgui.same_line()
