"""Channels of the rotating frame, of the strain gauge, and of tables that users write."""

import numpy as np
import pytest
from openfast_files import UNITS, channels, write_outb
from test_readers_csv import write as write_csv

from loadflow.errors import InputError
from loadflow.readers import read_channels, read_csv, read_loads, read_openfast
from loadflow.readers.aliases import LATERAL, aliases
from loadflow.readers.frames import turning_order

WEIGHT = 1069.0  # kN, of the rotor of the NREL 5 MW across its shaft
PAIRS = (("LSShftFys", "LSShftFzs"), ("LSSTipMys", "LSSTipMzs"))


def steady(n=2400, dt=0.025, seed=0):
    """Channels of a rotor that turns at 12 1/min under its weight, with a tilting moment."""
    rng = np.random.default_rng(seed)
    data = channels(n, dt, seed=seed)
    data["Azimuth"] = np.mod(72.0 * data["Time"] + 25.0, 360.0)
    data["RotSpeed"] = np.full(n, 12.0)
    data["RotTorq"] = np.full(n, 4000.0)
    for name, mean in zip(sum(PAIRS, ()), (5.0, -WEIGHT, 800.0, -200.0)):
        data[name] = mean + 20 * rng.normal(size=n)
    return data


def rotating(data):
    """The same channels as they appear in the frame that turns with blade 1."""
    found = {k: v for k, v in data.items() if k not in sum(PAIRS, ())}
    psi = np.radians(data["Azimuth"])
    for y, z in PAIRS:
        found[y[:-1] + "a"] = np.cos(psi) * data[y] + np.sin(psi) * data[z]
        found[z[:-1] + "a"] = -np.sin(psi) * data[y] + np.cos(psi) * data[z]
    return found


def units_of(data):
    return {k: UNITS.get(k, "(kN-m)" if "M" in k else "(kN)") for k in data}


def put(path, data):
    return write_outb(path, data, units_of(data), kind=3)


@pytest.mark.parametrize("frame", ["auto", "rotating"])
def test_rotating_channels_of_elastodyn_are_turned_back(tmp_path, frame):
    data = steady()
    expected = read_openfast(put(tmp_path / "fixed.outb", data))
    found = read_openfast(put(tmp_path / "turning.outb", rotating(data)), frame=frame)
    for key in ("hub_force", "hub_moment"):
        np.testing.assert_allclose(found[key], expected[key], atol=1.0)


def test_the_fixed_frame_is_asked_for_and_the_azimuth_must_be_there(tmp_path):
    data = rotating(steady())
    path = put(tmp_path / "a.outb", data)
    with pytest.raises(InputError, match="4 channels are missing: 'LSShftFys'"):
        read_openfast(path, frame="fixed")
    del data["Azimuth"]
    with pytest.raises(InputError, match=r"'Azimuth' or .* for 'azimuth' is missing"):
        read_openfast(put(path, data), frame="rotating")
    with pytest.raises(
        InputError, match="frame: must be one of fixed, rotating, auto, got 'turning'"
    ):
        read_openfast(path, frame="turning")


def test_the_gauge_may_turn_too(tmp_path):
    data, arm = steady(), 1.912
    expected = read_openfast(put(tmp_path / "fixed.outb", data))
    gauge = dict(data)
    gauge["LSSTipMys"] = data["LSSTipMys"] + arm * data["LSShftFzs"]
    gauge["LSSTipMzs"] = data["LSSTipMzs"] - arm * data["LSShftFys"]
    turning = {k.replace("LSSTip", "LSSGag"): v for k, v in rotating(gauge).items()}
    path = put(tmp_path / "gauge.outb", turning)
    found = read_openfast(path, gauge_distance=arm)
    np.testing.assert_allclose(found.hub_moment, expected.hub_moment, atol=1.0)
    with pytest.raises(InputError, match=r"'LSSGagMya' and 'LSSGagMza' if gauge_distance is given"):
        read_openfast(path)


def test_gauge_channels_are_the_same_as_those_of_the_shaft(tmp_path):
    data = steady()
    expected = read_openfast(put(tmp_path / "a.outb", data))
    names = {"RotThrust": "LSSGagFxs", "LSShftFys": "LSSGagFys", "LSShftFzs": "LSSGagFzs"}
    names |= {"RotTorq": "LSSGagMxs"}
    found = read_openfast(put(tmp_path / "b.outb", {names.get(k, k): v for k, v in data.items()}))
    for key in ("hub_force", "hub_moment"):
        np.testing.assert_array_equal(found[key], expected[key])
    for ending in ("Fxa", "Fxs", "Mxa", "Mxs"):
        key = "hub_force_x" if ending[0] == "F" else "hub_moment_x"
        assert f"LSSGag{ending}" in aliases("openfast").fixed[key]


def test_columns_of_any_file_may_turn(tmp_path):
    heading = ["time [s]", "speed [rpm]", "azimuth [rad]", "hub_force_x [N]", "hub_force_y [N]"]
    heading += ["hub_force_z [N]", *(f"hub_moment_{a} [N m]" for a in "xyz")]
    values = write_csv(tmp_path / "a.csv", heading)
    psi, y, z = values[:, 2], values[:, 4], values[:, 5]
    found = read_csv(tmp_path / "a.csv", frame="rotating")
    np.testing.assert_allclose(found.hub_force[1], np.cos(psi) * y - np.sin(psi) * z, rtol=1e-5)
    np.testing.assert_allclose(found.hub_force[2], np.sin(psi) * y + np.cos(psi) * z, rtol=1e-5)


def test_a_force_of_the_wrong_frame_is_doubted_with_numbers(tmp_path):
    data = steady()
    named = {key: name for key, (name, *_) in aliases("openfast").rotating.items()}
    named = {key: name for key, name in named.items() if key in LATERAL}
    path = put(tmp_path / "dlc11_v12_s1.outb", rotating(data))
    wrong = str(read_loads(path, channels=named, quiet=True)["doubts"].values[0])
    assert "turns -1 times a revolution (1069 kN; its mean is" in wrong
    assert "rotating frame" in wrong
    turned = read_loads(path, channels=named, frame="rotating", quiet=True)
    assert str(turned["doubts"].values[0]) == ""
    mirrored = named | {"hub_force_y": "-LSShftFya"}
    twice = read_loads(path, channels=mirrored, frame="rotating", quiet=True)
    assert "a sign or the azimuth is wrong" in str(twice["doubts"].values[0])


def test_the_order_of_turning_needs_a_rotor_that_turns():
    speed = np.full(1000, 1.2)
    angle = np.cumsum(speed) * 0.05
    for order in (-2, -1, 0, 1, 2):
        assert turning_order(np.exp(1j * order * angle), speed, 0.05)[0] == order
    assert turning_order(np.ones(1000, complex), 0.01 * speed, 0.05) is None


def test_tables_of_channels_come_from_file_text_or_mapping(tmp_path):
    expected = {"speed": ("Omega", "shaft"), "hub_force_x": ("-#23",)}
    path = tmp_path / "channels.toml"
    path.write_text('speed = ["Omega", "shaft"]\nhub_force_x = "-#23"\n')
    assert read_channels(path) == read_channels(str(path)) == expected
    path.write_text('[channels]\nspeed = ["Omega", "shaft"]\nhub_force_x = "-#23"\n')
    assert read_channels(path) == expected
    text = "speed=WSP gl. coo.,Vy, hub_force_x = -Fz coo: shaft"
    assert read_channels(text)["speed"] == ("WSP gl. coo.,Vy",)
    assert read_channels('{speed = "Omega", pitch = "Pi1"}')["pitch"] == ("Pi1",)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("speed = 3", r"channels\.toml: speed = 3 must be a name, or a list"),
        ("spede = 'Omega'", r"channels\.toml: 'spede' is nothing the cube holds; it takes speed"),
        ("speed = ", r"channels\.toml: not a TOML file"),
        ("speed = ''", "must be a name"),
    ],
)
def test_bad_tables_of_channels_are_refused(tmp_path, text, message):
    path = tmp_path / "channels.toml"
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        read_channels(path)


def test_a_table_that_is_absent_is_named():
    with pytest.raises(InputError, match=r"gone\.toml: cannot read the channels: No such file"):
        read_channels("gone.toml")


def test_a_channel_that_a_user_names_must_be_there(tmp_path):
    path = put(tmp_path / "a.outb", steady())
    with pytest.raises(InputError, match="channel 'Pitch7' for 'pitch' is missing"):
        read_openfast(path, channels={"pitch": "Pitch7"})


def test_a_format_that_says_its_time_lets_no_channel_say_it(tmp_path):
    write_outb(tmp_path / "a.outb", channels(n=20))
    with pytest.raises(InputError, match="say the time themselves"):
        read_openfast(tmp_path / "a.outb", channels={"time": "Time"})
