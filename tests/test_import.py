"""The package is light until it is used."""

import subprocess
import sys


def test_importing_the_package_loads_no_heavy_library():
    code = (
        "import sys, loadflow;"
        "heavy = ('numba', 'scipy', 'matplotlib', 'pandas', 'xarray');"
        "print([name for name in heavy if name in sys.modules])"
    )
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert result.stdout.strip() == "[]"
