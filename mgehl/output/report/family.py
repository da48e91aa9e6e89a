"""The module of a page's own sections: for loaded contacts, dry contacts and rigid bearings."""

from mgehl.output.report import dry, loaded, wedge


def family(solution):
    """The module that describes such a solution."""
    if solution.is_dry:
        return dry
    return loaded if solution.contact.is_loaded else wedge
