"""Runs notebooks from their first cell to the last one; fails where a cell does. Nothing is written."""

import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient

for name in sys.argv[1:]:
    notebook = nbformat.read(name, as_version=4)
    NotebookClient(notebook, timeout=600, resources={"metadata": {"path": str(Path(name).parent)}}).execute()
    print(name, "ran")
