"""Run a job in a child process that may crash, hang or eat memory without taking us along.

A shader can end or stall the process that compiles it (a division in a constant expression, an
endless loop in a driver call that no Python signal handler interrupts). So the job runs in a child,
forked before anything heavy is imported; the parent stays a bare Python that waits.
"""

import contextlib
import math
import os
import signal
import sys
import time

from .files import announce

TIMEOUT = 120.0  # seconds, unless the child asks for another limit
MEMORY = 4 << 30  # bytes the child may hold; the size check admits no picture that needs more
POLL = 0.05  # seconds between two looks at the child
LEISURE = 1.0  # between those at one without a time limit, which may be idle
_LIMIT = "limit="


def supervised(job):
    """Run `job()` in a child process and return its exit code, whatever happens to the child.

    The job returns an exit code; it may ask for another time limit with `limit_time`, and what it
    announces with `files.announce` is removed if it is killed. One line on standard error tells of
    a crash (exit code 1), a time-out (1), too much memory (1), Ctrl-C (130) or termination (143).
    Without `os.fork` (Windows) the job runs in this process, unsupervised.
    """
    if not hasattr(os, "fork"):
        return job()
    _flush()
    listen, channel = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(listen)
        _be_the_child(job, channel)
    os.close(channel)
    return _watch(child, listen)


def limit_time(seconds):
    """Ask the supervising process, if there is one, to end this one `seconds` after its start.

    With math.inf it lasts as long as it likes.
    """
    if "LUMIAR_SUPERVISOR" in os.environ:
        announce(f"{_LIMIT}{seconds}")
        # even if the parent itself is killed, this process ends
        signal.alarm(0 if seconds == math.inf else int(seconds) + 5)


def _be_the_child(job, channel):
    # A signal must end the child even inside a driver call, where no Python handler ever runs.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    os.environ["LUMIAR_SUPERVISOR"] = str(channel)
    code = 1
    try:
        limit_time(TIMEOUT)
        try:
            code = job()
        except SystemExit as end:  # argparse ends so
            code = end.code if isinstance(end.code, int) else 1
        _flush()
    except BrokenPipeError:  # the reader of our output has gone (`lumiar list | head`)
        pass
    except BaseException:
        sys.excepthook(*sys.exc_info())
    finally:
        with contextlib.suppress(OSError):
            _flush()
        os._exit(code)  # leaves out the interpreter's tidying-up, tens of milliseconds


def _flush():
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:  # closed by whoever started us
            stream.flush()


class _Ended(Exception):
    """A signal reached the parent; args[0] is its number."""


def _watch(child, listen):
    import select

    def on_signal(number, _frame):
        raise _Ended(number)

    signals = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    for number in signals:
        signal.signal(number, on_signal)
    started, seconds = time.monotonic(), TIMEOUT
    heard, why, code = b"", "", 1
    try:
        while not why:
            if select.select([listen], [], [], POLL if seconds < math.inf else LEISURE)[0]:
                message = os.read(listen, 65536)
                if not message:  # the child has ended
                    break
                heard += message
                seconds = _asked_limit(heard) or seconds
            if time.monotonic() - started > seconds:
                why = f"stopped after {seconds:g} s; --timeout SECONDS allows more"
            elif _resident(child) > MEMORY:
                why = f"stopped when it held {MEMORY >> 30} GB of memory"
    except _Ended as end:
        why = "interrupted" if end.args[0] == signal.SIGINT else "terminated"
        code = 128 + end.args[0]
    for number in signals:
        signal.signal(number, signal.SIG_IGN)  # nothing may stop the cleaning-up
    if why:
        os.kill(child, signal.SIGKILL)
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if status < 0 and not why:
        name = signal.Signals(-status).name
        why = f"the renderer ended with {name}; `lumiar source` shows what the driver was given"
    if not why:
        return status
    for path in heard.split(b"\0"):
        if path and not path.startswith(_LIMIT.encode()):
            with contextlib.suppress(OSError):
                os.unlink(path)
    print(f"lumiar: {why}", file=sys.stderr)
    return code


def _asked_limit(heard):
    """Return the last time limit in seconds among the complete messages, or None."""
    limits = [m for m in heard.split(b"\0")[:-1] if m.startswith(_LIMIT.encode())]
    return float(limits[-1][len(_LIMIT) :]) if limits else None


def _resident(process):
    """Return the bytes of memory that a process holds, 0 where the system does not tell."""
    try:
        with open(f"/proc/{process}/statm", "rb") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return 0
