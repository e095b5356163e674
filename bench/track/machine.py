# SPDX-License-Identifier: MIT
"""What must be equal before two runs may be compared: machine, compiler, flags, vector targets."""
import hashlib
import os


def cpu_model():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        fields = dict(line.split(":", 1) for line in file if ":" in line)
    fields = {name.strip(): value.strip() for name, value in fields.items()}
    return " ".join(fields.get(name, "?") for name in ("model name", "cpu family", "model", "stepping"))


def identity(context):
    """From the context that a benchmark program prints."""
    return {
        "machine": cpu_model(),
        "cores": os.cpu_count(),
        "caches": [f"L{c['level']} {c['type']} {c['size']}" for c in context["caches"]],
        "compiler": context["compiler"],
        "flags": context["flags"],
        "targets": context["targets"],
    }


def key(identity_):
    text = repr(sorted(identity_.items()))
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def differences(a, b):
    """['compiler: GCC 12.2 | Clang 14'] for everything that is not equal."""
    return [f"{name}: {a.get(name)} | {b.get(name)}" for name in sorted(a.keys() | b.keys()) if a.get(name) != b.get(name)]
