"""The settings for hubs in the docs: read as a hub reads them, and equal where they have to be."""

import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml
from traitlets.config import Config

from ai4u_edu.cli.server_proxy import server_proxy

pytestmark = pytest.mark.needs("hub")

DOCS = Path(__file__).parents[2] / "docs"
USE_CLASS = {"access:services!service=ai4u-class", "read:services!service=ai4u-class"}


def of_python(name: str) -> dict[str, Any]:
    """Return the service, the roles, the groups and the token's scopes of a hub's settings."""
    found = Config()
    text = (DOCS / name).read_text(encoding="utf-8")
    exec(compile(text, name, "exec"), {"get_config": lambda: found})  # noqa: S102 - our own
    hub = found.JupyterHub

    def as_list(value: Any) -> list[Any]:
        return value if isinstance(value, list) else value.get_value([])

    groups = hub.load_groups
    return {
        "services": {each["name"]: each for each in as_list(hub.services)},
        "roles": {each["name"]: each for each in as_list(hub.load_roles)},
        "groups": groups if isinstance(groups, dict) else groups.get_value({}),
        "token": found.Spawner.server_token_scopes,
        "cmd": found.Spawner.get("cmd", ""),
    }


def of_chart(name: str) -> dict[str, Any]:
    values = yaml.safe_load((DOCS / name).read_text(encoding="utf-8"))
    hub = values["hub"]
    return {
        "services": hub["services"],
        "roles": hub["loadRoles"],
        "groups": hub["config"]["JupyterHub"]["load_groups"],
        "token": hub["config"]["KubeSpawner"]["server_token_scopes"],
        "cmd": values["singleuser"]["cmd"],
        "ports": {
            values["proxy"]["chp"]["networkPolicy"]["egress"][0]["ports"][0]["port"],
            values["singleuser"]["networkPolicy"]["egress"][0]["ports"][0]["port"],
            hub["networkPolicy"]["ingress"][0]["ports"][0]["port"],
            hub["service"]["extraPorts"][0]["targetPort"],
        },
    }


@pytest.mark.parametrize(
    "name", ["jupyterhub_config.py", "jupyterhub_tljh.py", "jupyterhub_values.yaml"]
)
def test_the_settings_let_students_and_teachers_use_the_class(name: str) -> None:
    found = of_chart(name) if name.endswith("yaml") else of_python(name)
    service = found["services"]["ai4u-class"]
    assert service["url"].endswith(":10101")
    command = service["command"]
    assert command[command.index("ai4u_edu") :][1:3] == ["class", "--hub"]
    assert "--folder" in command
    assert set(found["token"]) >= {"users:activity!user", "access:servers!server", *USE_CLASS}
    assert set(found["roles"]["user"]["scopes"]) == {"self", *USE_CLASS}
    teachers = found["roles"]["ai4u-teachers"]
    assert set(teachers["scopes"]) >= USE_CLASS
    assert teachers["groups"] == ["ai4u-teachers"] == list(found["groups"])
    assert found.get("ports", {10101}) == {10101}
    if "127.0.0.1" not in service["url"]:
        assert command[command.index("--host") + 1] == "0.0.0.0"  # noqa: S104
    if found["cmd"]:  # the shell's own words come after what it runs
        assert found["cmd"][:2] == ["sh", "-c"]
        assert found["cmd"][3:] == ["sh"]


def test_the_token_of_a_tiles_world_is_in_no_command_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("JUPYTERHUB_API_TOKEN", "secret")
    monkeypatch.setenv("JUPYTERHUB_API_URL", "http://127.0.0.1:8081/hub/api")
    found = server_proxy()
    token = found["environment"]["AI4U_EDU_TOKEN"]
    assert found["request_headers_override"] == {"Authorization": f"Bearer {token}"}
    assert token not in found["command"]
    assert found["command"][-2:] == ["--class", "hub"]
    assert server_proxy()["environment"]["AI4U_EDU_TOKEN"] != token
    monkeypatch.delenv("JUPYTERHUB_API_URL")
    assert "--class" not in server_proxy()["command"]


@pytest.mark.nightly
@pytest.mark.timeout(1200)
@pytest.mark.skipif(sys.platform == "win32", reason="a script for containers")
def test_the_script_of_the_images_installs_a_students_server(tmp_path: Path) -> None:
    """Run what docs/jupyterhub.Dockerfile runs, without PyTorch."""
    steps = re.findall(r"^RUN sh (.*)$", (DOCS / "jupyterhub.Dockerfile").read_text(), re.MULTILINE)
    assert steps == [
        "/src/docs/jupyterhub_install.sh python3 /src hub,lessons,train",
        "/src/docs/jupyterhub_install.sh python3 /src",
    ]
    subprocess.run([sys.executable, "-m", "venv", tmp_path / "venv"], check=True)
    python = tmp_path / "venv" / "bin" / "python3"
    source = tmp_path / "src"
    # the build needs .ci
    names = shutil.ignore_patterns(
        ".git*", ".venv*", ".*_cache", "build", "__pycache__", "node_modules"
    )
    shutil.copytree(DOCS.parent, source, ignore=names)
    script = source / "docs" / "jupyterhub_install.sh"
    for extras in ("", "hub,lessons"):
        subprocess.run(["sh", script, python, source, extras], check=True, cwd=tmp_path)
    program = (
        "from importlib.metadata import entry_points\n"
        "tile, = entry_points(group='jupyter_serverproxy_servers', name='ai4u-edu')\n"
        "assert tile.load()()['command'][1:4] == ['-m', 'ai4u_edu', 'play']\n"
    )
    subprocess.run([python, "-c", program], check=True, cwd=tmp_path, env={})
    server = python.with_name("jupyterhub-singleuser")
    subprocess.run([server, "--version"], check=True, cwd=tmp_path)


@pytest.mark.parametrize("name", ["jupyterhub_config.py", "jupyterhub_tljh.py"])
@pytest.mark.parametrize("user", [0, 1000])
def test_a_class_that_logs_in_at_once_has_time(
    name: str, user: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("os.geteuid", lambda: user, raising=False)
    found = Config()
    exec(  # noqa: S102 - our own
        compile((DOCS / name).read_text(encoding="utf-8"), name, "exec"),
        {"get_config": lambda: found},
    )
    assert found.JupyterHub.concurrent_spawn_limit == 10
    assert found.Spawner.start_timeout > 60
    assert found.Spawner.http_timeout > 30
    is_root = user == 0 and name == "jupyterhub_config.py"
    assert ("--allow-root" in found.Spawner.args) == is_root


def test_a_class_that_logs_in_at_once_has_time_in_the_chart() -> None:
    values = yaml.safe_load((DOCS / "jupyterhub_values.yaml").read_text(encoding="utf-8"))
    assert values["hub"]["concurrentSpawnLimit"] == 30
    assert values["singleuser"]["startTimeout"] > 60
    assert values["hub"]["config"]["KubeSpawner"]["http_timeout"] > 30
