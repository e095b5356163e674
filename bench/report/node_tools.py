# SPDX-License-Identifier: MIT
"""Node.js with the packages of package-lock.json, in the build folder: the checkout may be read-only."""
import json
import pathlib
import shutil

HERE = pathlib.Path(__file__).resolve().parent
NO_NODE = "{} is not installed (apt-get install nodejs npm)"


class NodeError(ValueError):
    pass


def prepare(programs, run):
    """Returns the folder of our scripts beside the programs of bench/, with the packages, installed by npm on first use; none
    of their scripts is run. `run` takes a command, and raises ValueError if it fails."""
    for program in ("node", "npm"):
        if not shutil.which(program):
            raise NodeError(NO_NODE.format(program))
    folder = pathlib.Path(programs) / "node"
    folder.mkdir(exist_ok=True)
    for file in (HERE / "package.json", HERE / "package-lock.json", *HERE.glob("*.mjs")):
        shutil.copy(file, folder)
    needed = json.loads((HERE / "package.json").read_text(encoding="utf-8"))["dependencies"]
    if not all((folder / "node_modules" / name / "package.json").is_file() for name in needed):
        print(f"npm installs {', '.join(needed)} into {folder}", flush=True)
        try:
            run(["npm", "ci", "--prefix", folder, "--ignore-scripts", "--omit=dev", "--no-audit", "--no-fund",
                 "--fetch-retries=1", "--fetch-retry-mintimeout=1000", "--fetch-timeout=30000"])
        except ValueError as error:
            raise NodeError(f"npm could not install {', '.join(needed)} (is there a network?): {error}") from error
    return folder
