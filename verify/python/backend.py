# SPDX-License-Identifier: MIT
"""Makes a wheel of what lies in limitcheck/, compiled already: `pip install` needs no network and no other package."""
import base64
import hashlib
import sysconfig
import zipfile
from pathlib import Path

HERE = Path(__file__).parent


def build_wheel(folder, config_settings=None, metadata_directory=None):
    version = (HERE / "version").read_text().strip()
    tag = f"cp{sysconfig.get_config_var('py_version_nodot')}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    name = f"limitcheck-{version}-{tag}-{tag}-{platform}.whl"
    info = f"limitcheck-{version}.dist-info"
    records = []
    with zipfile.ZipFile(Path(folder) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        def add(path, content):
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            records.append(f"{path},sha256={digest},{len(content)}")
            wheel.writestr(path, content)

        for file in sorted((HERE / "limitcheck").iterdir()):
            if file.is_file():
                add(f"limitcheck/{file.name}", file.read_bytes())
        add(f"{info}/METADATA", f"Metadata-Version: 2.1\nName: limitcheck\nVersion: {version}\n"
            "Summary: Judges tessellators of subdivision surfaces\nRequires-Dist: numpy\n".encode())
        add(f"{info}/WHEEL", f"Wheel-Version: 1.0\nGenerator: limitcheck\nRoot-Is-Purelib: false\n"
            f"Tag: {tag}-{tag}-{platform}\n".encode())
        wheel.writestr(f"{info}/RECORD", "\n".join([*records, f"{info}/RECORD,,", ""]))
    return name
