"""What fluid and cavities have besides pressure and film: fields that older results are without."""


def fluid_fields(solution):
    """The fluid's own pressure in Pa, the filling of the gap, and shear in Pa, (ny, nx) each, by name.

    Under contact the fluid's pressure is that of the fluid in the layers; the filling is below 1
    in cavities alone. Old results have neither; only surfaces that slide have the last.
    """
    fields = solution.fields
    if fields.p is None or fields.filling is None:
        return {}
    found = {"fluid_pressure": fields.p * solution.contact.pressure_scale, "filling": fields.filling}
    return found if fields.shear is None else found | {"shear": fields.shear}
