"""The papers, books and standards whose formulas and data are used: one table, which all others name.

`mgehl cite` prints those of a run. A DOI stands where it is known for certain.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Source:
    """One publication."""

    sort: str
    """BibTeX's: article, book, phdthesis, misc."""
    authors: str
    year: int
    title: str
    where: str
    """Journal with volume and pages, publisher, or institution."""
    doi: str = ""

    @property
    def people(self):
        """Authors, an institution without the braces by which BibTeX does not take it apart."""
        return self.authors.replace("{", "").replace("}", "")

    @property
    def short(self):
        """Family names and year."""
        names = [name.partition(",")[0] for name in self.people.split(" and ")]
        return f"{', '.join(names) if len(names) < 4 else names[0] + ' et al.'} {self.year}"

    def bibtex(self, key):
        """An entry of BibTeX."""
        place = {"article": "journal", "book": "publisher", "phdthesis": "school"}.get(self.sort, "note")
        fields = {
            "author": self.authors,
            "title": f"{{{self.title}}}",
            place: self.where,
            "year": self.year,
        }
        fields |= {"doi": self.doi} if self.doi else {}
        inner = ",\n".join(f"  {name:9} = {{{value}}}" for name, value in fields.items())
        return f"@{self.sort}{{{key},\n{inner}\n}}"


SOURCES = {
    "liu2021": Source(
        "article", "Liu, S. and Wang, Q. J. and Chung, Y.-W. and Berkebile, S.", 2021,
        "Lubrication-contact interface conditions and novel mixed/boundary lubrication modeling "
        "methodology",
        "Tribology Letters 69, 164", "10.1007/s11249-021-01515-w",
    ),
    "elrod1981": Source(
        "article", "Elrod, H. G.", 1981, "A cavitation algorithm",
        "Journal of Lubrication Technology 103, 350-354", "10.1115/1.3251669",
    ),
    "johnson1985": Source(
        "book", "Johnson, K. L.", 1985, "Contact Mechanics", "Cambridge University Press",
        "10.1017/CBO9781139171731",
    ),
    "yastrebov2017": Source(
        "article", "Yastrebov, V. A. and Anciaux, G. and Molinari, J.-F.", 2017,
        "On the accurate computation of the true contact-area in mechanical contact of random rough "
        "surfaces",
        "Tribology International 114, 161-171",
    ),
    "barus1893": Source(
        "article", "Barus, C.", 1893, "Isothermals, isopiestics and isometrics relative to viscosity",
        "American Journal of Science 45, 87-96", "10.2475/ajs.s3-45.266.87",
    ),
    "roelands1966": Source(
        "phdthesis", "Roelands, C. J. A.", 1966,
        "Correlational aspects of the viscosity-temperature-pressure relationship of lubricating oils",
        "Delft University of Technology",
    ),
    "dowson1966": Source(
        "book", "Dowson, D. and Higginson, G. R.", 1966,
        "Elasto-hydrodynamic lubrication: the fundamentals of roller and gear lubrication",
        "Pergamon Press",
    ),
    "grubin1949": Source(
        "misc", "Grubin, A. N.", 1949,
        "Fundamentals of the hydrodynamic theory of lubrication of heavily loaded cylindrical surfaces",
        "Central Scientific Research Institute for Technology and Mechanical Engineering, Book 30; "
        "the idea is A. M. Ertel's of 1939",
    ),
    "hamrock1977": Source(
        "article", "Hamrock, B. J. and Dowson, D.", 1977,
        "Isothermal elastohydrodynamic lubrication of point contacts, part III: fully flooded results",
        "Journal of Lubrication Technology 99, 264-275", "10.1115/1.3453074",
    ),
    "hamrock1978": Source(
        "article", "Hamrock, B. J. and Dowson, D.", 1978,
        "Elastohydrodynamic lubrication of elliptical contacts for materials of low elastic modulus, part "
        "I: fully flooded conjunction",
        "Journal of Lubrication Technology 100, 236-245", "10.1115/1.3453152",
    ),
    "chittenden1985": Source(
        "article", "Chittenden, R. J. and Dowson, D. and Dunn, J. F. and Taylor, C. M.", 1985,
        "A theoretical analysis of the isothermal elastohydrodynamic lubrication of concentrated contacts, "
        "part II: general case",
        "Proceedings of the Royal Society A 397, 271-294", "10.1098/rspa.1985.0015",
    ),
    "moes1992": Source(
        "article", "Moes, H.", 1992,
        "Optimum similarity analysis with applications to elastohydrodynamic lubrication",
        "Wear 159, 57-66", "10.1016/0043-1648(92)90286-H",
    ),
    "nijenbanning1994": Source(
        "article", "Nijenbanning, G. and Venner, C. H. and Moes, H.", 1994,
        "Film thickness in elastohydrodynamically lubricated elliptic contacts",
        "Wear 176, 217-229", "10.1016/0043-1648(94)90150-3",
    ),
    "gupta1992": Source(
        "article", "Gupta, P. K. and Cheng, H. S. and Zhu, D. and Forster, N. H. and Schrand, J. B.", 1992,
        "Viscoelastic effects in MIL-L-7808-type lubricant, part I: analytical formulation",
        "Tribology Transactions 35, 269-274", "10.1080/10402009208982117",
    ),
    "eyring1936": Source(
        "article", "Eyring, H.", 1936,
        "Viscosity, plasticity, and diffusion as examples of absolute reaction rates",
        "Journal of Chemical Physics 4, 283-291", "10.1063/1.1749836",
    ),
    "ehret1998": Source(
        "article", "Ehret, P. and Dowson, D. and Taylor, C. M.", 1998,
        "On lubricant transport conditions in elastohydrodynamic conjunctions",
        "Proceedings of the Royal Society A 454, 763-787",
    ),
    "carslaw1959": Source(
        "book", "Carslaw, H. S. and Jaeger, J. C.", 1959, "Conduction of heat in solids",
        "Oxford University Press",
    ),
    "arana2019": Source(
        "article", "Arana, A. and Larranaga, J. and Ulacia, I.", 2019,
        "Partial EHL friction coefficient model to predict power losses in cylindrical gears",
        "Proceedings of the Institution of Mechanical Engineers, Part J 233, 303",
    ),
    "astmd341": Source(
        "misc", "{ASTM International}", 2020,
        "Standard practice for viscosity-temperature equations and charts for liquid petroleum or "
        "hydrocarbon products",
        "ASTM D341; the equation is C. Walther's of 1931",
    ),
    "iso6336": Source(
        "misc", "{International Organization for Standardization}", 2019,
        "Calculation of load capacity of spur and helical gears, part 2", "ISO 6336-2",
    ),
    "astmf2094": Source(
        "misc", "{ASTM International}", 2018,
        "Standard specification for silicon nitride bearing balls", "ASTM F2094/F2094M",
    ),
    "goto1989": Source(
        "article", "Goto, T. and Anderson, O. L. and Ohno, I. and Yamamoto, S.", 1989,
        "Elastic constants of corundum up to 1825 K", "Journal of Geophysical Research 94, 7588-7602",
    ),
    "schott": Source("misc", "{Schott AG}", 2014, "N-BK7", "data sheet of the optical glass"),
    "victrex": Source("misc", "{Victrex plc}", 2014, "PEEK 450G", "data sheet"),
    "handbook": Source(
        "book", "{ASM International}", 1990, "Metals handbook, volume 2: properties and selection",
        "ASM International",
    ),
}  # fmt: skip
"""By their keys in BibTeX."""
