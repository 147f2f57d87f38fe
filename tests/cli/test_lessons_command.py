"""``ai4u-edu lessons``: the JupyterLab that it starts."""

import json
import subprocess
from pathlib import Path

import pytest

from ai4u_edu.cli.lessons import FIRST, KERNEL_STOP_S, lab
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.needs("lessons")


def test_a_kernel_is_killed_soon_after_the_end(tmp_path: Path) -> None:
    """JupyterLab would wait 5 s and more for a kernel whose cell does not return."""
    from jupyter_client.manager import KernelManager

    (tmp_path / FIRST).write_text("{}")
    command = [*lab(tmp_path, 8888, open_page=False), "--show-config-json"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=LIMIT_S)
    config = json.loads(done.stdout)
    assert config["KernelManager"] == {"shutdown_wait_time": KERNEL_STOP_S}
    assert "shutdown_wait_time" in KernelManager.class_trait_names(config=True)
    assert config["ServerApp"]["jpserver_extensions"]["jupyter_lsp"] is False
