"""What fluid and cavities have besides pressure and film: fields that older results are without."""


def fluid_fields(solution):
    """The fluid's own pressure in Pa, the filling of the gap, shear in Pa, rises in K, (ny, nx), by name.

    Under contact the fluid's pressure is that of the fluid in the layers; the filling is below 1
    in cavities alone. Old results have neither; only surfaces that slide have the last three.
    """
    fields = solution.fields
    if fields.p is None or fields.filling is None:
        return {}
    found = {"fluid_pressure": fields.p * solution.contact.pressure_scale, "filling": fields.filling}
    maps = {name: getattr(fields, name) for name in ("shear", "flash_1", "flash_2")}
    return found | {name: each for name, each in maps.items() if each is not None}
