"""What there is besides pressure and film: fields that smooth bodies or older results are without."""


def further_fields(solution):
    """The fluid's own pressure in Pa, the filling of the gap, heights in m, shear and rises, by name.

    Under contact the fluid's pressure is that of the fluid in the layers; the filling is below 1
    in cavities alone. A peak is positive. What a result has not is left out.
    """
    fields = solution.fields
    pressure = None if fields.p is None else fields.p * solution.contact.pressure_scale
    found = {"fluid_pressure": pressure, "filling": fields.filling, "heights": fields.heights}
    found |= {name: getattr(fields, name) for name in ("shear", "flash_1", "flash_2")}
    return {name: values for name, values in found.items() if values is not None}
