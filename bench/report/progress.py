# SPDX-License-Identifier: MIT
"""Programs run with the time they take shown on a terminal."""
import subprocess
import sys
import tempfile
import time


def say(text):
    end = "\r\033[K" if sys.stderr.isatty() else ""
    print(end + text, file=sys.stderr, flush=True)


def run(command, label, expected, stdout):
    """Waits for a program; returns its exit code and the end of what it said. `expected`: seconds of the last time, or None."""
    start = time.monotonic()
    with tempfile.TemporaryFile() as words:
        with subprocess.Popen([str(c) for c in command], stdin=subprocess.DEVNULL, stdout=stdout, stderr=words) as process:
            try:
                while True:
                    try:
                        process.wait(timeout=1)
                        break
                    except subprocess.TimeoutExpired:
                        if sys.stderr.isatty():
                            of = f" of about {expected:.0f}" if expected else ""
                            print(f"\r\033[K{label}: {time.monotonic() - start:.0f}{of} s", end="", file=sys.stderr, flush=True)
            except BaseException:
                # Asked first: a program may have started others, and have files to clear away.
                process.terminate()
                try:
                    process.wait(timeout=5)
                finally:
                    process.kill()
                raise
        words.seek(0)
        return process.returncode, words.read().decode(errors="replace").strip()
