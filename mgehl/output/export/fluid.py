"""What fluid and cavities have besides pressure and film: fields that older results are without."""


def fluid_fields(solution):
    """The fluid's own pressure in Pa and the filling of the gap, (ny, nx) each, by name.

    Under contact the fluid's pressure is that of the fluid in the layers; the filling is below 1
    in cavities alone. Old results have neither.
    """
    fields = solution.fields
    if fields.p is None or fields.filling is None:
        return {}
    return {"fluid_pressure": fields.p * solution.contact.pressure_scale, "filling": fields.filling}
