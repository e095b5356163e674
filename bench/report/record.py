# SPDX-License-Identifier: MIT
"""What is in the report's folder: when, how and from which source each part was made, and what failed."""
import contextlib
import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "track"))
import machine  # noqa: E402

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def commit():
    """Of the source tree; with a star if it was changed since. '' where there is no git."""
    try:
        done = subprocess.run(["git", "-C", SOURCE, "describe", "--always", "--dirty=*", "--abbrev=12", "--exclude=*"],
                              capture_output=True, text=True, check=False)
        return done.stdout.strip()
    except OSError:
        return ""


def write_whole(path, text):
    partial = path.with_name(path.name + ".partial")
    partial.write_text(text, encoding="utf-8")
    partial.replace(path)


class Record:
    """reproduction.json in the folder; saved at every change."""

    def __init__(self, folder, parts):
        self.path, self.folder, self.parts = folder / "reproduction.json", folder, parts
        self.commit = commit()
        self.state = {}
        if self.path.is_file():
            try:
                self.state = {n: s for n, s in json.loads(self.path.read_text(encoding="utf-8"))["parts"].items() if n in parts}
            except (ValueError, KeyError, AttributeError) as error:
                raise ValueError(f"{self.path} is broken ({error}): remove it") from error

    def save(self):
        write_whole(self.path, json.dumps({"format": 1, "parts": self.state}, indent=1) + "\n")

    def made(self, name):
        """{made, seconds, quick, commit, machine, cores, system} of the result in the folder, or None."""
        return self.state.get(name, {}).get("result")

    def has(self, name):
        return bool(self.made(name)) and all((self.folder / file).is_file() for file in self.parts[name].files)

    def problem(self, name):
        return self.state.get(name, {}).get("problem")

    def seconds(self, name, quick):
        result = self.made(name)
        return result["seconds"] if result and result["quick"] == quick else None

    def fail(self, name, why):
        """What was there before stays, with its own date."""
        self.state.setdefault(name, {})["problem"] = why
        self.save()

    @contextlib.contextmanager
    def making(self, name, quick):
        start = time.monotonic()
        self.fail(name, "interrupted")  # true if this process ends without another word
        yield
        self.state[name] = {"result": {
            "made": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
            "seconds": round(time.monotonic() - start, 1), "quick": quick, "commit": self.commit,
            "machine": machine.cpu_model(), "cores": os.cpu_count(), "system": platform.platform()}}
        self.save()
