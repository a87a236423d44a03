"""A row of the panel: symbol and name, tooltip, a button that resets, a list to choose from."""

from imgui_bundle import imgui

from .notation import symbol

DIM = (0.62, 0.66, 0.72, 1.0)
BRIGHT = (1.0, 0.85, 0.5, 1.0)  # of symbols
GOOD, BAD, WHITE = (0.5, 0.9, 0.55, 1.0), (1.0, 0.55, 0.5, 1.0), (1.0, 1.0, 1.0, 1.0)
_SMALL = 0.72  # of the size of letters


def row(name, words, text="", tip=None, ways=(), ending=""):
    """Begin a row: a symbol and a name; what is drawn next stands to their right.

    text: of a Parameter, which may begin with its symbol; tip: its tooltip, text or a function that
    draws it; ending: a unit that the value does not show. ways: (name, value in words), …, to set
    it back, those of `words` that are named so. Then a button that takes the first one, with Shift
    the last, stands at the right end, and a right click offers all of them, and to type a value.
    Returns the way that was chosen, or "".
    """
    width, begin, em = (
        imgui.get_content_region_avail().x,
        imgui.get_cursor_pos_x(),
        imgui.get_font_size(),
    )
    imgui.begin_group()
    imgui.align_text_to_frame_padding()
    letter, below = symbol(name, text)
    if letter:
        _written(letter, below)
        imgui.same_line(0.0, 0.4 * em)
    if (letter, below) != (name, ""):
        imgui.text(words["names"].get(name, name.replace("_", " ")))
    if ending:
        imgui.same_line(0.0, 0.4 * em)
        _small(ending, DIM, 0.22)
    imgui.same_line(begin + label_width(width) - 1.0)
    imgui.dummy((1.0, 1.0))  # so that the tooltip belongs to all of the label's place
    imgui.end_group()
    if tip and imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip):
        _tip(tip)
    chosen = _menu(words, ways) if callable(tip) else ""
    if ways:
        imgui.same_line(begin + width - 1.5 * em)
        if imgui.button("↺", (1.5 * em, 0.0)):
            chosen = ways[-1 if imgui.get_io().key_shift else 0][0]
        said = [f"↺  {words[way]}: {value}" for way, value in ways]
        imgui.set_item_tooltip("\nShift + ".join(said))
    imgui.same_line(begin + label_width(width))
    imgui.set_next_item_width(width - label_width(width) - 1.8 * em)
    if chosen == "type":
        imgui.set_keyboard_focus_here()
    return chosen


def _menu(words, ways):
    """Offer, at a right click on the name, what sets a value back, or to type one."""
    chosen = ""
    imgui.open_popup_on_item_click("ways", imgui.PopupFlags_.mouse_button_right)
    if imgui.is_popup_open("ways") and imgui.begin_popup("ways"):
        for way, value in ways:
            if imgui.selectable(f"{words[way]}: {value}##{way}", False)[0]:
                chosen = way
        if imgui.selectable(words["type"], False)[0]:
            chosen = "type"
        imgui.end_popup()
    return chosen


def label_width(width):
    """Return how wide the names are in rows of that width."""
    return min(0.38 * width, 12.0 * imgui.get_font_size())


def choice(key, current, options, hint=""):
    """Draw a list to choose from, with a field to type in where `hint` is given.

    Returns the option chosen or the text typed, None for none. options: a sequence of texts or
    pairs (what is returned, what is shown), or a function that returns one when the list is open.
    """
    chosen = None
    if not imgui.begin_combo(f"##{key}", current, imgui.ComboFlags_.height_large):
        return None
    if hint:
        imgui.set_next_item_width(-1.0)
        entered, text = imgui.input_text_with_hint(
            "##path", hint, "", imgui.InputTextFlags_.enter_returns_true
        )
        if entered and text.strip():
            chosen = text.strip()
            imgui.close_current_popup()
    for option in options() if callable(options) else options:
        given, said = option if isinstance(option, tuple) else (option, option)
        if imgui.selectable(said, said == current)[0]:
            chosen = given
        if said == current and imgui.is_window_appearing():
            imgui.set_scroll_here_y()
    imgui.end_combo()
    return chosen


def pick(key, current, options):
    """Draw options, see `choice`, side by side where there is room, else as a list.

    Returns the one that was chosen, else `current`.
    """
    gap, padding = 2.0, imgui.get_style().frame_padding.x
    pairs = [option if isinstance(option, tuple) else (option, str(option)) for option in options]
    said = [text for _, text in pairs]
    needs = [imgui.calc_text_size(text).x + 2.0 * padding for text in said]
    spare = imgui.calc_item_width() - sum(needs) - gap * (len(needs) - 1)
    if spare < 0.0:
        chosen = choice(key, dict(pairs).get(current, ""), pairs)
        return current if chosen is None else chosen
    color = imgui.get_style().color_(imgui.Col_.frame_bg)
    chosen = current
    for i, ((option, text), need) in enumerate(zip(pairs, needs, strict=True)):
        if i:
            imgui.same_line(0.0, gap)
        if option != current:
            imgui.push_style_color(imgui.Col_.button, color)
        if imgui.button(text, (need + spare / len(needs), 0.0)):
            chosen = option
        if option != current:
            imgui.pop_style_color()
    return chosen


def wrapped(text, colour=WHITE):
    """Write a text in as many lines as it takes."""
    imgui.push_text_wrap_pos(0.0)
    imgui.text_colored(colour, text)
    imgui.pop_text_wrap_pos()


def gesture(state):
    """Return the key for History of what is done now, None while no widget is held."""
    held = imgui.is_any_item_active()
    if held and state.gesture is None:
        state.holds += 1
    state.gesture = state.holds if held else None
    return state.gesture


def _tip(tip):
    if imgui.begin_tooltip():
        imgui.push_text_wrap_pos(28.0 * imgui.get_font_size())
        tip() if callable(tip) else imgui.text(tip)
        imgui.pop_text_wrap_pos()
        imgui.end_tooltip()


def _written(letter, below):
    """Write a symbol with its subscript."""
    imgui.text_colored(BRIGHT, letter)
    if below:
        imgui.same_line(0.0, 0.0)
        _small(below, BRIGHT, 0.38)


def _small(text, color, lower):
    """Write in small letters, lower than the line by so many of its heights."""
    imgui.set_cursor_pos_y(imgui.get_cursor_pos_y() + lower * imgui.get_font_size())
    imgui.push_font(None, _SMALL * imgui.get_style().font_size_base)
    imgui.text_colored(color, text)
    imgui.pop_font()
