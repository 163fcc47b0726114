"""Control of the rotor: speed and pitch, supervisory states, individual pitch."""
