"""Undo and redo: what was comes back, and one drag is one step."""

from lumiar.history import MOST, History
from lumiar.scene import Scene


def test_undo_and_redo_walk_over_every_scene():
    scenes = [Scene.default().set(exposure=float(i)) for i in range(4)]
    history = History(scenes[0])
    for scene in scenes[1:]:
        assert history.push(scene) is scene
    assert [history.undo() for _ in range(5)] == [*scenes[2::-1], scenes[0], scenes[0]]
    assert [history.redo() for _ in range(4)] == [*scenes[1:], scenes[3]]


def test_a_drag_is_one_step_and_two_drags_are_two():
    history = History(0)
    for key, values in ((1, (1, 2, 3)), (2, (4, 5))):
        for value in values:
            history.push(value, key)
    assert (history.undo(), history.undo(), history.undo()) == (3, 0, 0)


def test_letting_go_ends_a_drag():
    history = History(0)
    history.push(1, "k")
    history.push(1, None)
    history.push(2, "k")
    assert (history.undo(), history.undo()) == (1, 0)


def test_a_drag_goes_on_over_frames_that_change_nothing():
    history = History(0)
    for value in (1, 1, 2, 2, 3):
        history.push(value, "k")
    assert history.undo() == 0


def test_undoing_within_a_drag_begins_another():
    history = History(0)
    history.push(1, "k")
    assert history.undo() == 0
    history.push(2, "k")
    assert history.undo() == 0 and history.redo() == 2


def test_a_change_forgets_what_was_undone_and_no_change_does_not():
    history = History(0)
    history.push(1)
    history.undo()
    history.push(0)
    assert history.redo() == 1
    history.undo()
    history.push(2)
    assert history.redo() == 2 and history.undo() == 0


def test_it_does_not_grow_without_end():
    history = History(0)
    for value in range(1, 3 * MOST):
        history.push(value)
    steps = 0
    while history.undo() != 2 * MOST - 1:
        steps += 1
    before = history.scene
    assert history.undo() == before and steps == MOST - 1
