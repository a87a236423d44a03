"""The tool that compares: which pictures stand beside each other, and by what they differ."""

from imgui_bundle import imgui

from . import catalog, compare, geometry, labels, notation, sections, settings
from .comparing import TEXT
from .editing import PICTURE
from .parts import LIGHT, RATES
from .picture import in_language


class Comparing:
    """Draws the tool; it keeps nothing, as all is in the document's Comparison."""

    def release(self):
        """Do nothing: nothing is held."""

    def draw(self, now):
        """Draw the tool and return the scene; what is compared it tells the document."""
        words, before = TEXT[now.state.lang]["compare"], now.document.beside.comparison
        comparison = _modes(before, now, words)
        imgui.separator_text(words["begin"])
        comparison = _begin(comparison, now, words)
        if comparison is before:  # what is shown is what was compared
            comparison = _pictures(comparison, now, words)
        imgui.dummy((1.0, 0.3 * imgui.get_font_size()))
        imgui.push_text_wrap_pos(0.0)
        imgui.text_disabled(words["drop"])
        imgui.pop_text_wrap_pos()
        if comparison is not before:
            now.document.beside.show(comparison, labels.gesture(now.state))
            now.state.restless = True
        return now.scene


def _modes(comparison, now, words):
    """Draw the ways in which pictures can be shown."""
    imgui.set_next_item_width(-1.0)
    names = [(mode, words[mode]) for mode in compare.MODES]
    mode = labels.pick("mode", comparison.mode, names)
    imgui.push_text_wrap_pos(0.0)
    imgui.text_disabled(words["mode tips"][mode])
    imgui.pop_text_wrap_pos()
    if mode == comparison.mode:
        return comparison
    return compare.in_mode(comparison, mode, now.scene)


def _begin(comparison, now, words):
    """Draw the buttons that make a comparison in one click."""
    wide = (imgui.get_content_region_avail().x, 0.0)
    if imgui.button(words["rates"], wide):
        return compare.rates()
    imgui.set_next_item_width(-1.0)
    comparison = _models(comparison, now, words)
    count = len(comparison.variants) if comparison.mode == "grid" else 1
    full = count >= compare.MOST
    imgui.begin_disabled(full)
    if imgui.button(words["same but"], wide):
        imgui.open_popup("same but")
    imgui.set_item_tooltip(words["full" if full else "same but tip"])
    found = _menu("same but", now.scene, now, words)
    if found:
        comparison = compare.added(comparison, compare.Variant((found,)))
    letter = compare.LETTERS[min(count, compare.MOST - 1)]
    if imgui.button(words["keep"].format(letter), wide):
        comparison = compare.added(comparison, compare.Variant(kept=now.scene))
    imgui.set_item_tooltip(words["full" if full else "keep tip"])
    imgui.end_disabled()
    return comparison


def _models(comparison, now, words):
    """Draw the list of models, of which several can be ticked."""
    keys = [dict(one.values).get("model") for one in comparison.variants]
    alone = comparison.mode == "one" or not all(keys)
    now_shown = [one.model.name for one in now.scene.objects[:1]]
    chosen = now_shown if alone else keys
    if not imgui.begin_combo("##models", words["models"], imgui.ComboFlags_.height_large):
        return comparison
    for name in catalog.names("model"):
        ticked = name in chosen
        full = len(chosen) >= compare.MOST and not ticked
        imgui.begin_disabled(full)
        changed, _ = imgui.checkbox(name, ticked)
        imgui.end_disabled()
        if changed:
            left = [one for one in chosen if one != name]
            left = left if ticked else [*left, name]
            comparison = compare.models(left) if left else comparison
    imgui.end_combo()
    return comparison


def _pictures(comparison, now, words):
    """Draw each picture: its letter, by what it differs, and what is done with it."""
    shown = now.document.beside.pictures
    several = comparison.mode != "one"
    for i, (variant, one) in enumerate(zip(comparison.shown, shown, strict=True)):
        if not several:
            break
        imgui.push_id(i)
        right = imgui.get_cursor_pos_x() + imgui.get_content_region_avail().x
        caption = in_language(variant.caption, now.state.lang)
        imgui.separator_text(f"{words['picture']} {compare.LETTERS[i]}   {caption}")
        if len(comparison.variants) > 1:
            imgui.same_line(right - 1.4 * imgui.get_font_size())
            if imgui.small_button("×"):
                imgui.pop_id()
                return compare.without(comparison, i)
            imgui.set_item_tooltip(words["remove"])
        comparison = _picture(comparison, i, variant, one, now, words)
        imgui.pop_id()
        if comparison is not now.document.beside.comparison:
            return comparison
    if several and len(comparison.variants) > 1 and imgui.button(words["swap"]):
        return compare.swapped(comparison)
    return comparison


def _picture(comparison, i, variant, one, now, words):
    """Draw what there is to change of one picture, and return the comparison."""
    changed = variant
    if variant.kept:
        imgui.align_text_to_frame_padding()
        imgui.text_disabled(words["kept"])
        imgui.same_line()
        _, follows = imgui.checkbox(words["follow"], not variant.apart)
        changed = variant._replace(apart=not follows)
    elif not variant.values:
        imgui.text_disabled(words["edited"])
    elif one.scene:
        changed = _values(variant, one.scene, now, words)
    if one.fault:
        imgui.text_wrapped(one.fault)
    if not variant.kept and variant.values:
        if imgui.small_button(words["but"]):
            imgui.open_popup("but")
        found = _menu("but", one.scene or now.scene, now, words)
        if found:
            rest = tuple(pair for pair in variant.values if pair[0] != found[0])
            changed = variant._replace(values=(*rest, found), caption={})
    return (
        comparison
        if changed is variant or changed == variant
        else compare.replaced(comparison, i, changed)
    )


def _values(variant, scene, now, words):
    """Draw a row for each value by which a picture differs; return its Variant."""
    for key, value in variant.values:
        imgui.push_id(key)
        if imgui.small_button("−"):
            left = tuple(pair for pair in variant.values if pair[0] != key)
            imgui.pop_id()
            return variant._replace(values=left, caption={})
        imgui.set_item_tooltip(words["drop value"])
        imgui.same_line()
        if key == "light":
            imgui.text(f"{words['light']} {value}")
        else:
            after = sections.some(scene, now.state, now.words, (key,))
            variant = variant if after is scene else compare.edited(variant, after)
        imgui.pop_id()
    return variant


def _menu(name, scene, now, words):
    """Draw the menu of what may be different; return the (key, value) that was chosen, or None."""
    found = None
    if not imgui.begin_popup(name):
        return None
    lists = {
        "rate": ("shading", lambda: RATES),
        "model": ("model", lambda: catalog.names("model")),
        "mesh": ("mesh", lambda: (*geometry.SHAPES, *geometry.shipped())),
        "light": ("light", lambda: catalog.names("light")),
    }
    for title, (key, options) in lists.items():
        if imgui.begin_menu(words[title]):
            for option in options():
                if imgui.menu_item_simple(option):
                    found = (key, settings.canonical(key, option))
            imgui.end_menu()
    if imgui.begin_menu(words["value"]):
        for key in _keys(scene):
            one, value, lamp, _ = settings.found(scene, key)
            title = now.words["names"].get(one.name, one.name.replace("_", " "))
            title = f"{lamp.name or lamp.kind.name}: {title}" if lamp else title
            letter = "".join(notation.symbol(one.name, one.text))
            if imgui.menu_item_simple(f"{title}##{key}", "" if letter == title else letter):
                found = (key, _another(one, value))
        imgui.end_menu()
    imgui.end_popup()
    return found


def _keys(scene):
    """Return the keys of values, as `settings.changed` takes them, that a picture may differ by."""
    keys = dict.fromkeys(name for one in scene.objects for name in one.values)
    shapes = [geometry.shape(one.mesh) for one in scene.objects]
    keys |= dict.fromkeys(f"mesh.{name}" for shape in shapes for name in shape)
    keys |= dict.fromkeys(("rotation",) if scene.objects else ())
    for i, one in enumerate(scene.lights, 1):
        own = settings.own_keys(one.kind)
        names = (*one.values, *(name for name in LIGHT if name in own))
        keys |= dict.fromkeys(f"light.{i}.{name}" for name in names)
    keys |= dict.fromkeys(name for name in PICTURE if name != "shading")
    found = ((key, settings.found(scene, key)) for key in keys)
    return [key for key, at in found if at and at[1] is not None and at[0].widget != "time"]


def _another(one, value):
    """Return a value of a Parameter that is another one: a choice's next, else some way off."""
    if one.widget == "toggle":
        return not value
    if one.widget == "choice":
        return one.choices[(one.choices.index(value) + 1) % len(one.choices)]
    if one.widget != "slider" or isinstance(value, tuple):
        return value
    ends = (one.low, one.high)
    logarithmic = one.low > 0.0 and one.high / one.low >= 1e2
    far = max(ends, key=lambda end: abs(end - value))
    if logarithmic:
        far = max(ends, key=lambda end: max(end / value, value / end))
        other = (value * far) ** 0.5
    else:
        other = 0.5 * (value + far)
    return one.check(round(other) if one.type == "int" else float(f"{other:.2g}"))
