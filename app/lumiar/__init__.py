"""Lumiar: a GPU shader playground for illumination and shading.

from lumiar import Scene, capture
capture(Scene.load("teapot").set(shininess=80), "teapot.png")
"""

__version__ = "0.1.0"
__all__ = ["Mistake", "Renderer", "Scene", "capture"]
_HOMES = {"Mistake": "errors", "Renderer": "renderer", "Scene": "scene", "capture": "picture"}


def __getattr__(name):
    """Import what is asked for only now: the command line pays for no module it does not need."""
    if name not in _HOMES:
        raise AttributeError(f"module 'lumiar' has no attribute '{name}'")
    from importlib import import_module

    return getattr(import_module(f"lumiar.{_HOMES[name]}"), name)
