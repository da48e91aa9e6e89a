"""What only pages of loaded contacts have, or only those of rigid bearings."""

from mgehl.output.report import dry, loaded, wedge


def family(solution):
    """The module that describes such a solution."""
    if solution.is_dry:
        return dry
    return loaded if solution.contact.is_loaded else wedge
