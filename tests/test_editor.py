"""The editor in the real window: typed, drawn, marked, saved, put by; nothing typed is lost."""

import json
import math
import os

import pytest
from hand import spied
from test_window import MODEL, plain, press, save, settle, shown

from lumiar import Scene, arguments, editor, gallery, labels, verbs
from lumiar.desktop import glfw
from lumiar.document import Document
from lumiar.errors import Mistake
from lumiar.files import GLSL
from lumiar.window import Viewer

SIZE = (1000, 600)
CTRL = glfw.MOD_CONTROL


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path


@pytest.fixture
def own(folder):
    path = folder / "own.glsl"
    path.write_text(MODEL % "")
    return path


@pytest.fixture
def viewer(own):
    with Viewer(plain().changed("model", str(own)), "en", hidden=True, size=SIZE) as one:
        settle(one)
        press(one, glfw.KEY_F7)
        yield one


@pytest.fixture
def look(monkeypatch):
    """Return a function that draws a window once more, and returns a Spy of its editor."""

    return lambda one: spied(one, monkeypatch, (editor, labels))


def click(one, place):
    one.desktop.move(*place)
    settle(one)
    one.desktop.button(0, glfw.PRESS, 0)
    one.frame()
    one.desktop.button(0, glfw.RELEASE, 0)
    settle(one)


def on(one, spy, label):
    """Click on what the editor has drawn."""
    left, top, right, bottom = spy.places[label]
    click(one, ((left + right) / 2, (top + bottom) / 2))


def into(one):
    """Click into the text, at the end of a line of it."""
    click(one, (900, 160))


def write(one, text):
    for letter in text:
        one.desktop.letter(ord(letter))
        one.frame()


def rest(one):
    """Wait until what was typed has been looked at."""
    one.document.look(math.inf)
    settle(one)


def typed(one):
    return one.drawer.tool.sheets[one.drawer.tool.path].text


def append(one, text):
    """Type at the end of the text."""
    into(one)
    press(one, glfw.KEY_END, CTRL)
    one.desktop.key(glfw.KEY_LEFT_CONTROL, glfw.RELEASE, 0)
    settle(one)
    write(one, text)


def test_what_is_typed_is_drawn_before_it_is_saved(viewer, own):
    before = shown(viewer)
    into(viewer)
    drawn = typed(viewer)
    assert drawn == MODEL % "" and not viewer.document.texts.drafts
    viewer.document.gate.edit(str(own), drawn.replace("k * tint", "tint"), 0.0)
    rest(viewer)
    assert (shown(viewer) != before).any() and own.read_text() == MODEL % ""
    assert "own.glsl" in gallery.caption(viewer.document, "en")
    assert typed(viewer) == drawn.replace("k * tint", "tint")
    press(viewer, glfw.KEY_S, CTRL)
    assert own.read_text() == typed(viewer) and not viewer.document.texts.drafts
    assert "own.glsl" not in gallery.caption(viewer.document, "en")


def test_a_mistake_is_marked_on_its_line_while_the_last_picture_stays(viewer, own):
    before = shown(viewer)
    append(viewer, "+")
    assert shown(viewer).tobytes() == before.tobytes()  # not before a moment has passed
    rest(viewer)
    line = (MODEL % "").count("\n") + 1
    assert f"{own}:{line}: " in viewer.document.fault + viewer.stage.fault
    assert viewer.drawer.tool.sheet.has_markers()
    assert (shown(viewer) == before).all()
    press(viewer, glfw.KEY_BACKSPACE)
    rest(viewer)
    assert not viewer.document.fault + viewer.stage.fault
    assert not viewer.drawer.tool.sheet.has_markers() and not viewer.document.texts.drafts
    assert (shown(viewer) == before).all()


def test_keys_belong_to_the_text_while_somebody_types(viewer):
    scene = viewer.scene
    append(viewer, "// hRp")
    for key in (glfw.KEY_H, glfw.KEY_R, glfw.KEY_P, glfw.KEY_ESCAPE, glfw.KEY_PAGE_UP):
        press(viewer, key)
    assert viewer.with_panel and not viewer.presents and not viewer.desktop.closing
    press(viewer, glfw.KEY_Z, CTRL)
    assert typed(viewer) == (MODEL % "") + "// hR\n"
    assert viewer.scene.camera == scene.camera
    press(viewer, glfw.KEY_F1)  # but these go to the window
    assert viewer.with_keys
    press(viewer, glfw.KEY_F7)
    assert not viewer.drawer.open


def test_every_key_reaches_imgui(viewer):
    for key in ("APOSTROPHE", "SEMICOLON", "LEFT_BRACKET", "BACKSLASH", "F3", "KP_DIVIDE"):
        assert getattr(glfw, f"KEY_{key}") in viewer.desktop._keys


def test_unsaved_text_survives_closing_the_tool_another_model_and_another_file(viewer, own):
    append(viewer, "// mine")
    press(viewer, glfw.KEY_F7)
    press(viewer, glfw.KEY_F7)
    assert typed(viewer).endswith("// mine\n")
    viewer._push(viewer.scene.changed("model", "lambert"))
    settle(viewer)
    assert viewer.drawer.tool.path == os.path.join(GLSL, "models", "lambert.glsl")
    viewer.document.undo()
    settle(viewer)
    assert viewer.drawer.tool.path == str(own) and typed(viewer).endswith("// mine\n")
    assert own.read_text() == MODEL % ""


def test_unsaved_text_survives_closing_the_window(viewer, own):
    before = shown(viewer)
    changed = (MODEL % "").replace("0.4)", "0.9)")
    viewer.document.gate.edit(str(own), changed, 0.0)
    viewer.release()
    scene = plain().changed("model", str(own))
    with Viewer(Document(scene, restored=True), "en", hidden=True, size=SIZE) as again:
        press(again, glfw.KEY_F7)
        assert typed(again) == changed and (shown(again) != before).any()
    assert own.read_text() == MODEL % ""


def test_a_window_opened_afresh_offers_what_was_left(viewer, own, look):
    left = (MODEL % "") + "// left"
    viewer.document.gate.edit(str(own), left, 0.0)
    viewer.release()
    for answer, text in (("Take them up", left), ("Leave them", MODEL % "")):
        with Viewer(plain().changed("model", str(own)), "en", hidden=True, size=SIZE) as again:
            press(again, glfw.KEY_F7)
            assert typed(again) == MODEL % ""
            on(again, look(again), answer)
            assert typed(again) == text and answer not in look(again).places
    assert json.loads((own.parent / "cache/lumiar/drafts.json").read_text()) == {}


def test_a_file_saved_elsewhere_meanwhile_is_nobodys_loss(viewer, own, look):
    append(viewer, "// mine")
    theirs = (MODEL % "") + "// theirs"
    save(viewer, own, theirs)
    press(viewer, glfw.KEY_S, CTRL)
    assert own.read_text() == theirs and typed(viewer).endswith("// mine\n")
    on(viewer, look(viewer), "Keep mine")
    press(viewer, glfw.KEY_S, CTRL)
    assert own.read_text() == (MODEL % "") + "// mine\n"
    append(viewer, "!")
    save(viewer, own, theirs)
    on(viewer, look(viewer), "Take theirs")
    assert typed(viewer) == theirs and not viewer.document.texts.drafts
    into(viewer)
    press(viewer, glfw.KEY_Z, CTRL)  # and what was typed can be had back
    assert typed(viewer).endswith("// mine!")


def test_a_file_that_is_saved_elsewhere_is_shown_as_it_is(viewer, own):
    save(viewer, own, MODEL % " * 2.0")
    assert typed(viewer) == MODEL % " * 2.0"
    save(viewer, own, MODEL % " * nope")
    assert viewer.drawer.tool.sheet.has_markers()


def test_line_ends_stay_as_they_are(viewer, own):
    save(viewer, own, (MODEL % "").replace("\n", "\r\n"))
    own.write_bytes((MODEL % "").replace("\n", "\r\n").encode())
    viewer._reload([str(own)])
    settle(viewer)
    append(viewer, "// x")
    press(viewer, glfw.KEY_S, CTRL)
    assert own.read_bytes() == ((MODEL % "") + "// x\n").replace("\n", "\r\n").encode()


def test_what_comes_with_lumiar_is_saved_as_a_copy_that_the_scene_then_uses(folder, look):
    phong = os.path.join(GLSL, "models", "phong.glsl")
    with open(phong) as file:
        text = file.read()
    with Viewer(plain().set(shininess=9), "en", hidden=True, size=SIZE) as viewer:
        press(viewer, glfw.KEY_F7)
        viewer.document.gate.edit(phong, text.replace("value * INV_PI", "value"), 0.0)
        rest(viewer)
        edited = shown(viewer)
        press(viewer, glfw.KEY_S, CTRL)
        (folder / "taken.glsl").write_text("mine")
        for name, said in (("taken", "exists already"), ("../x", "without folders"), ("", "name")):
            viewer.drawer.tool._name = name
            on(viewer, look(viewer), "Write")
            assert said in viewer.drawer.tool._refused
        viewer.drawer.tool._name = "mine"
        on(viewer, look(viewer), "Write")
        assert (folder / "taken.glsl").read_text() == "mine"
        assert (folder / "mine.glsl").read_text() == text.replace("value * INV_PI", "value")
        one = viewer.scene.objects[0]
        assert one.model.path == str(folder / "mine.glsl") and one.values["shininess"] == 9
        assert (shown(viewer) == edited).all() and not viewer.document.texts.drafts
        assert viewer.drawer.tool.path == str(folder / "mine.glsl")
    with open(phong) as file:
        assert file.read() == text


def test_a_broken_text_can_be_saved_as_a_copy_too(viewer, own, look, folder):
    before = shown(viewer)
    append(viewer, "}")
    on(viewer, look(viewer), "Save a copy …")
    on(viewer, look(viewer), "Write")
    copy = folder / "my_own.glsl"
    assert copy.read_text().endswith("}\n") and own.read_text() == MODEL % ""
    assert f"{copy}:5: " in viewer.document.fault and (shown(viewer) == before).all()
    save(viewer, copy, MODEL % "")
    assert not viewer.document.fault and (shown(viewer) == before).all()


def test_a_new_model_is_whole_and_is_drawn(viewer, look, folder):
    before = shown(viewer)
    on(viewer, look(viewer), "New model …")
    on(viewer, look(viewer), "Write")
    model = viewer.scene.objects[0].model
    assert model.path == str(folder / "my_model.glsl") and model.header["model"] == "my model"
    assert not viewer.document.fault + viewer.stage.fault and (shown(viewer) != before).any()
    viewer.document.undo()
    settle(viewer)
    assert (shown(viewer) == before).all()


def test_what_models_share_can_be_read_and_is_followed(viewer, look):
    phong = plain().objects
    viewer._push(viewer.scene._replace(objects=phong))
    settle(viewer)
    lobe = os.path.join(GLSL, "lib", "lobe.glsl")
    assert lobe in viewer.document.watch.paths
    spy = look(viewer)
    on(viewer, spy, "##file")
    on(viewer, look(viewer), f"lobe.glsl   (lib/)##{lobe}")
    into(viewer)
    write(viewer, "x")
    with open(lobe) as file:
        assert typed(viewer) == file.read()  # nothing was typed into it
    library = viewer.scene.objects[0].model.library
    viewer._reload([lobe])
    settle(viewer)
    assert viewer.scene.objects[0].model.library != library and not viewer.stage.fault


def test_a_model_with_a_mistake_named_at_the_start_opens_and_recovers(own, look):
    for broken in ("// model Own\nvec3 scatter(vec3 L", MODEL % " * nope"):
        own.write_text(broken)
        options = arguments.parse("view", [str(own), "--set", "samples=1"])
        load = lambda options=options: verbs._viewed(options)  # noqa: E731
        try:
            one = Document(load(), "own")
        except Mistake as mistake:
            one = Document.expecting(load, "own", "", mistake)
        with Viewer(one, "en", hidden=True, size=SIZE) as viewer:
            press(viewer, glfw.KEY_F7)
            neutral = shown(viewer)
            assert f"{own}:" in viewer.document.fault + viewer.stage.fault
            assert typed(viewer) == broken and viewer.drawer.tool.sheet.has_markers()
            save(viewer, own, MODEL % "")
            assert not viewer.document.fault + viewer.stage.fault
            assert viewer.scene.objects[0].model.text == MODEL % ""
            assert viewer.scene.samples == 1 and (shown(viewer) != neutral).any()


def test_a_scene_with_a_mistake_named_at_the_start_opens_and_recovers(folder):
    path = folder / "one.toml"
    path.write_text("samples = 2\n")
    options = arguments.parse("view", [str(path)])
    with pytest.raises(Mistake) as mistake:
        verbs._viewed(options)
    one = Document.expecting(lambda: verbs._viewed(options), "one", str(path), mistake.value)
    with Viewer(one, "en", hidden=True, size=SIZE) as viewer:
        press(viewer, glfw.KEY_F7)
        assert typed(viewer) == "samples = 2\n" and viewer.drawer.tool.sheet.has_markers()
        into(viewer)
        press(viewer, glfw.KEY_A, CTRL)
        viewer.desktop.key(glfw.KEY_LEFT_CONTROL, glfw.RELEASE, 0)
        write(viewer, "samples = 1")
        press(viewer, glfw.KEY_S, CTRL)
        save(viewer, path, "samples = 1")
        assert viewer.scene.samples == 1 and not viewer.document.fault
        assert viewer.document.path == str(path)


def test_nothing_is_awaited_once_another_scene_is_open(folder):
    broken, other = folder / "broken.toml", folder / "other.toml"
    broken.write_text("samples = 2\n")
    other.write_text("samples = 4\n")
    with pytest.raises(Mistake) as mistake:
        Scene.load(str(broken))
    one = Document.expecting(lambda: Scene.load(str(broken)), "", str(broken), mistake.value)
    one.drop(str(other))
    assert not one.fault and not one.awaits
    broken.write_text("samples = 9\n")
    one.reload([str(broken)])
    assert (one.name, one.scene.samples) == ("other", 4)


def test_a_file_that_does_not_exist_still_ends_in_one_line(lumiar):
    for arguments_ in (["nothing.glsl"], ["--model", "nothing.glsl"], ["nothing.toml"]):
        assert "nothing." in lumiar("view", *arguments_, code=2).stderr


def test_the_editor_costs_little_and_the_idle_window_nothing(viewer):
    rest(viewer)
    viewer.awake = 0.0
    assert not any(viewer.frame() for _ in range(5))


@pytest.mark.parametrize("lang", ["en", "pt"])
def test_its_words_are_there_in_both_languages(lang):
    words = editor.TEXT[lang]["editor"]
    assert words.keys() == editor.TEXT["en"]["editor"].keys() and all(words.values())
