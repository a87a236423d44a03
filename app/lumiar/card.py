"""An OpenGL context without a window, programs compiled in it, and the life of what lives in it."""

from contextlib import suppress

import moderngl

from .errors import Mistake, one_line

INSTALL = "install a driver: on Debian or Ubuntu `apt install libegl1 libgl1-mesa-dri`"


def open_context():
    """Return a moderngl context without a window, OpenGL 3.3 or later; raise Mistake if none."""
    with suppress(Exception):  # this is the fast way; moderngl's own tries more of them
        from glcontext import egl

        names = {"libgl": "libGL.so.1", "libegl": "libEGL.so.1"}
        raw = egl.create_context(mode="standalone", glversion=330, **names)
        return moderngl.create_context(context=raw, require=330)
    try:
        return moderngl.create_context(standalone=True, require=330)
    except Exception as error:  # moderngl raises nothing more specific
        reason = one_line(error, 120)
        raise Mistake(f"needs OpenGL 3.3, but none could be opened ({reason}); {INSTALL}") from None


def window_context():
    """Return the moderngl context of the window whose OpenGL context is the current one."""
    try:
        moderngl.init_context()  # create_context would, once others are open, look for GLX alone
        context = moderngl.get_context()
        if context.version_code < 330:
            raise ValueError(f"it has {context.version_code / 100}")
        return context
    except Exception as error:  # moderngl raises nothing more specific
        raise Mistake(f"needs OpenGL 3.3 ({one_line(error, 120)}); {INSTALL}") from None


def compiled(context, sources):
    """Return the program of sources {stage: Source}; raise Mistake naming file:line."""
    texts = {f"{stage}_shader": source.text for stage, source in sources.items()}
    try:
        return context.program(**texts)
    except moderngl.Error as error:
        from . import driverlog

        path, line, message = driverlog.locate(str(error), sources)
        where = f"{path}:{line}: " if path else ""
        raise Mistake(f"{where}the driver does not compile this: {message}") from None


class OnCard:
    """What holds objects in one OpenGL context, its own unless one is given."""

    def __init__(self, context=None):
        self.context = context or open_context()
        self._owns_context = context is None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.release()

    def release(self):
        """Free everything on the graphics card; the second time does nothing."""
        if self.context is None:
            return
        with self.context:
            self._free()
            if self._owns_context and (idle := self.context.extra):
                (attachment,) = idle.color_attachments
                attachment.release()
                idle.release()
        if self._owns_context:
            self.context.release()
        self.context = None

    def _free(self):
        """Free what the class itself has made, in the context."""

    def free_framebuffer(self, framebuffer):
        """Free a framebuffer and what is attached to it; one that goes while bound is an error."""
        context = self.context  # who shares it shares the idle one, which stays bound
        context.extra = context.extra or context.framebuffer([context.renderbuffer((1, 1))])
        context.extra.use()
        for attachment in (*framebuffer.color_attachments, framebuffer.depth_attachment):
            if attachment:
                attachment.release()
        framebuffer.release()
