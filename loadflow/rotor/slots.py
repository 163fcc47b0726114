"""Places of the numbers that the compiled loop carries along and writes out."""

# columns of the output; the pitch of each blade follows them
(
    SPEED, PITCH, AZIMUTH, FX, FY, FZ, MX, MY, MZ, WIND_X, WIND_Y, WIND_Z, TIP, TORQUE, STATE,
    GENERATOR, FORE_AFT, SIDE_SIDE, ROOT,
) = range(19)  # fmt: skip
COLUMNS = ROOT + 6  # force and moment of blade 1 at its root

# slots of the scalar state: rotor, wind over the disc
S_AZIMUTH, S_SPEED, S_RATE, S_AXIAL, S_Y, S_Z = range(6)
# speed and pitch control: filtered generator speed, integral, collective pitch, generator torque,
# integrals of the individual pitch
S_FILTERED, S_INTEGRAL, S_PITCH, S_TORQUE, S_TILT, S_YAW = range(6, 12)
# supervision: state, whether the event has happened, lowest pitch allowed, closing of the brake
S_STATE, S_HAPPENED, S_FLOOR, S_BRAKE = range(12, 16)
# schedule of the lowest pitch: power that it sees, what it asks for
S_POWER, S_LOWEST = range(16, 18)
SLOTS = 18
